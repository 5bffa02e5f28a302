"""Answers as PIDF-LO, the location format of emergency calls (RFC 4119, RFC 5491, RFC 7459)."""

import re
from datetime import UTC, datetime, timedelta
from typing import Final
from xml.etree.ElementTree import Element, SubElement, register_namespace, tostring

import numpy as np

from app.http.schemas.responses import LocalizeResponse
from index.answering.answers import Estimate, LatLon

NAMESPACES: Final = {
    "": "urn:ietf:params:xml:ns:pidf",
    "gp": "urn:ietf:params:xml:ns:pidf:geopriv10",
    "gbp": "urn:ietf:params:xml:ns:pidf:geopriv10:basicPolicy",
    "gml": "http://www.opengis.net/gml",
    "gs": "http://www.opengis.net/pidflo/1.0",
    "con": "urn:ietf:params:xml:ns:geopriv:conf",
}
WGS84: Final = "urn:ogc:def:crs:EPSG::4326"  # latitude first
METRES: Final = "urn:ogc:def:uom:EPSG::9001"
DEGREES: Final = "urn:ogc:def:uom:EPSG::9102"
MIN_AXIS_RATIO: Final = 1.5  # of an ellipse; a rounder one is a circle
RETENTION: Final = timedelta(hours=24)  # the default of RFC 4119
MIN_RADIUS_M: Final = 0.1
EXAMPLE: Final = (
    f'<presence xmlns="{NAMESPACES[""]}" entity="pres:5f0c@hereabouts.invalid"><note>status: no_match</note></presence>'
)
_NOT_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
for _prefix, _uri in NAMESPACES.items():
    register_namespace(_prefix, _uri)


def presence_document(response: LocalizeResponse, now: datetime | None = None) -> bytes:
    """Convert an answer to a presence document; without a position it has no tuple.

    It has one location, the estimate: several locations in a document have to describe the same place (RFC 5491, rule
    3), so the other places stay out. The shape contains the person with 90 % probability, whichever place is right: the
    circle, or an ellipse of its area with the axes of the covariance.
    """
    presence = Element(_tag("presence"), entity=f"pres:{response.request_id}@hereabouts.invalid")  # names nobody
    if response.estimate is not None:
        assert response.estimate.wgs84 is not None
        _add_location(presence, response.estimate, response.estimate.wgs84, now or datetime.now(UTC))
    question = [f"question: {response.question.text}"] if response.question else []
    warnings = (f"warning: {warning}" for warning in response.warnings)
    for note in (f"status: {response.status}", *question, *warnings, response.provenance.attribution):
        _add(presence, "note", _NOT_XML.sub("\ufffd", note))
    return tostring(presence, encoding="utf-8", xml_declaration=True)


def _add_location(presence: Element, estimate: Estimate, wgs84: LatLon, now: datetime) -> None:
    entry = SubElement(presence, _tag("tuple"), id="estimate")
    geopriv = SubElement(SubElement(entry, _tag("status")), _tag("gp:geopriv"))
    location = SubElement(geopriv, _tag("gp:location-info"))
    radius_m = max(estimate.radius_m.p90, MIN_RADIUS_M)
    variances, axes = np.linalg.eigh(estimate.covariance)
    ratio = float(np.sqrt(variances[1] / variances[0]))
    is_ellipse = ratio > MIN_AXIS_RATIO
    shape = SubElement(location, _tag("gs:Ellipse" if is_ellipse else "gs:Circle"), srsName=WGS84)
    _add(shape, "gml:pos", f"{wgs84.lat:.7f} {wgs84.lon:.7f}")
    if is_ellipse:
        east, north = axes[:, 1]
        _add(shape, "gs:semiMajorAxis", f"{radius_m * ratio**0.5:.1f}", uom=METRES)
        _add(shape, "gs:semiMinorAxis", f"{max(radius_m / ratio**0.5, MIN_RADIUS_M):.1f}", uom=METRES)
        _add(shape, "gs:orientation", f"{np.degrees(np.arctan2(east, north)) % 180:.1f}", uom=DEGREES)  # from north
    else:
        _add(shape, "gs:radius", f"{radius_m:.1f}", uom=METRES)
    _add(location, "con:confidence", "90", pdf="normal")
    rules = SubElement(geopriv, _tag("gp:usage-rules"))
    _add(rules, "gbp:retransmission-allowed", "false")
    _add(rules, "gbp:retention-expiry", _date_time(now + RETENTION))
    _add(geopriv, "gp:method", "Derived")
    _add(entry, "timestamp", _date_time(now))


def _add(parent: Element, name: str, text: str, **attributes: str) -> None:
    SubElement(parent, _tag(name), attributes).text = text


def _tag(name: str) -> str:
    prefix, _, local = name.rpartition(":")
    return f"{{{NAMESPACES[prefix]}}}{local}"


def _date_time(moment: datetime) -> str:
    return moment.isoformat(timespec="seconds").replace("+00:00", "Z")
