"""The manifests are what a cluster takes, agree with each other, with docker-compose.yml and with the application."""

import json
import re
import shutil
import subprocess
from pathlib import Path

import kubernetes_validate
import pytest
import yaml
from fastapi.testclient import TestClient

from app.http.keys import OPEN
from app.limits import MAX_DEADLINE_MS
from app.main import create_app
from app.server import CLOSING_S
from app.settings import Settings
from index.stores.milvus_connection import TOKEN, URI
from models.errors import IndexMismatch
from tests.dockerfile import command_of, option, user_id
from tests.manifests import LAYERS, ROOT, built, containers, kustomization, name, one, pods_of, template

DOCS = Path(__file__).parent.parent / "docs"
SERVICES = yaml.safe_load((ROOT.parent / "docker-compose.yml").read_text())["services"]
COMPOSE = {"base": ("index", "api"), "milvus": ("index-milvus", "api-milvus")}
OLDEST, NEWEST = "1.27", "1.37"  # releases whose schemas are asked
OF_MILVUS = {variable.removeprefix("HEREABOUTS_").lower() for variable in (URI, TOKEN)}  # read where they are used
OF_FILES = {"cache_dir"}  # as `models.files.cache_directory` reads it
MADE = {("job", "hereabouts-index-3")}  # of a CronJob, by a command on the page
PROBES = ("startupProbe", "livenessProbe", "readinessProbe")
EXTRA_FILES = {name: list(yaml.safe_load_all((ROOT / name).read_text())) for name in ("maps.yaml", "shards.yaml")}
ALL = [
    *((layer, document) for layer in LAYERS for document in built(layer)),
    *((name.removesuffix(".yaml"), document) for name, documents in EXTRA_FILES.items() for document in documents),
]
IDS = [f"{layer}-{document['kind']}-{name(document)}" for layer, document in ALL]


def api(layer: str) -> dict:
    [container] = containers([one(built(layer), "Deployment")])
    return container


def indexer(layer: str) -> dict:
    [container] = containers([one(built(layer), "CronJob", "hereabouts-index")])
    return container


def selected(labels: dict, documents: list[dict]) -> list[str]:
    """The components whose pods a selector takes."""
    made = [pods["metadata"]["labels"] for pods in map(template, documents) if pods]
    return [own["app.kubernetes.io/component"] for own in made if labels.items() <= own.items()]


@pytest.mark.parametrize("version", [OLDEST, NEWEST])
@pytest.mark.parametrize(("layer", "document"), ALL, ids=IDS)
def test_a_manifest_is_what_a_cluster_takes(layer, document, version) -> None:
    assert kubernetes_validate.validate(document, version, strict=True) == version


@pytest.mark.parametrize("layer", LAYERS)
def test_every_file_is_used(layer) -> None:
    layer_file = kustomization(layer)
    used = [*layer_file["resources"], *(patch["path"] for patch in layer_file.get("patches", ()))]
    files = [path.name for path in (ROOT / layer).iterdir() if path.name != "kustomization.yaml"]
    assert sorted(each for each in used if not each.startswith("../")) == sorted(files)
    assert {path.name for path in ROOT.iterdir()} == {*LAYERS, *EXTRA_FILES}


@pytest.mark.parametrize("layer", LAYERS)
def test_kustomize_makes_the_same_of_them(layer) -> None:
    commands = (["kustomize", "build"], ["kubectl", "kustomize"])
    there = [command for command in commands if shutil.which(command[0])]
    if not there:
        pytest.skip("takes kustomize or kubectl")
    made = subprocess.run([*there[0], str(ROOT / layer)], capture_output=True, check=True).stdout
    key = json.JSONEncoder(sort_keys=True).encode
    assert sorted(map(key, yaml.safe_load_all(made))) == sorted(map(key, built(layer)))


@pytest.mark.parametrize("layer", LAYERS)
def test_each_selector_takes_the_pods_that_it_is_for(layer) -> None:
    documents = built(layer)
    deployment = one(documents, "Deployment")
    assert selected(deployment["spec"]["selector"]["matchLabels"], documents) == ["api"]
    assert selected(one(documents, "Service")["spec"]["selector"], documents) == ["api"]
    assert selected(one(documents, "PodDisruptionBudget")["spec"]["selector"]["matchLabels"], documents) == ["api"]
    [spread] = pods_of(deployment)["spec"]["topologySpreadConstraints"]
    assert selected(spread["labelSelector"]["matchLabels"], documents) == ["api"]
    for policy, component in (("hereabouts", "api"), ("hereabouts-index", "index")):
        labels = one(documents, "NetworkPolicy", policy)["spec"]["podSelector"]["matchLabels"]
        assert selected(labels, documents) == [component]
    scaled = one(documents, "HorizontalPodAutoscaler")["spec"]
    assert scaled["scaleTargetRef"] == {"apiVersion": "apps/v1", "kind": "Deployment", "name": name(deployment)}
    job = one(documents, "CronJob", "hereabouts-index")["spec"]["jobTemplate"]["spec"]
    assert deployment["spec"]["progressDeadlineSeconds"] >= job["activeDeadlineSeconds"], "new pods wait for its index"
    assert "replicas" not in deployment["spec"], "or each apply would undo the autoscaler"
    assert scaled["minReplicas"] > one(documents, "PodDisruptionBudget")["spec"]["maxUnavailable"]


@pytest.mark.parametrize("document", [document for _, document in ALL if template(document)], ids=name)
def test_a_pod_may_do_next_to_nothing(document) -> None:
    pods = pods_of(document)["spec"]
    assert pods["enableServiceLinks"] is False, "a service called hereabouts would set HEREABOUTS_PORT=tcp://..."
    assert pods["automountServiceAccountToken"] is False
    assert pods["securityContext"]["runAsNonRoot"] is True
    assert pods["securityContext"]["seccompProfile"] == {"type": "RuntimeDefault"}
    assert pods["securityContext"]["runAsUser"] == user_id(), "the image's own"
    assert "initContainers" not in pods
    [container] = containers([document])
    assert container["securityContext"] == {
        "allowPrivilegeEscalation": False,
        "readOnlyRootFilesystem": True,
        "capabilities": {"drop": ["ALL"]},
    }
    assert all(volume["emptyDir"]["sizeLimit"] for volume in pods["volumes"] if "emptyDir" in volume)


@pytest.mark.parametrize("layer", LAYERS)
def test_what_may_be_written_is_the_same_as_with_compose(layer) -> None:
    for service, container in zip(COMPOSE[layer], (indexer(layer), api(layer)), strict=True):
        volumes = [volume.split(":")[1:] for volume in SERVICES[service]["volumes"] if not volume.startswith("$")]
        writable = {place for place, *way in volumes if way != ["ro"]} | set(SERVICES[service]["tmpfs"])
        mounted = {mount["mountPath"] for mount in container["volumeMounts"] if not mount.get("readOnly")}
        assert mounted == writable
    [index] = [mount for mount in api(layer)["volumeMounts"] if mount["mountPath"] == "/data"]
    assert index["readOnly"] is True


@pytest.mark.parametrize("layer", LAYERS)
def test_an_index_is_built_as_with_compose(layer) -> None:
    composed, args = SERVICES[COMPOSE[layer][0]]["command"], indexer(layer)["args"]
    assert len(args) == len(composed)
    assert {ours for ours, theirs in zip(args, composed, strict=True) if ours != theirs} == {"/maps/town.osm.pbf"}
    assert "args" not in api(layer), "the image's own"


def test_shards_are_shared_out_and_then_merged() -> None:
    shards, merge = (one(EXTRA_FILES["shards.yaml"], "Job", f"hereabouts-{called}") for called in ("shards", "merge"))
    count = shards["spec"]["completions"]
    assert (shards["spec"]["completionMode"], merge["spec"]["suspend"]) == ("Indexed", True)
    [sharing], [merging] = containers([shards]), containers([merge])
    ours = indexer("base")
    plain = [word for word in ours["args"] if word != "--keep-current"]
    assert merging["args"] == [*plain, "--merge", str(count)]
    made = [
        subprocess.run(
            [*sharing["command"], sharing["args"][0].replace("exec ", "echo ")],
            env={"JOB_COMPLETION_INDEX": str(number)},
            capture_output=True,
            text=True,
            check=True,
        ).stdout.split()
        for number in range(count)
    ]
    assert made == [[*plain, "--shard", f"{number}/{count}"] for number in range(1, count + 1)]
    pods = pods_of(one(built("base"), "CronJob", "hereabouts-index"))["spec"]
    for each in (shards, merge):
        [container] = containers([each])
        for name_of in ("resources", "securityContext", "volumeMounts"):
            assert container[name_of] == ours[name_of]
        others = {key: value for key, value in pods_of(each)["spec"].items() if key != "containers"}
        assert others == {key: value for key, value in pods.items() if key != "containers"}


@pytest.mark.parametrize("layer", LAYERS)
def test_every_volume_is_claimed_and_mounted(layer) -> None:
    documents = built(layer)
    claims = {name(document) for document in documents if document["kind"] == "PersistentVolumeClaim"}
    used = set()
    for pods in filter(None, map(template, documents)):
        volumes = pods["spec"]["volumes"]
        mounted = {mount["name"] for container in pods["spec"]["containers"] for mount in container["volumeMounts"]}
        assert {volume["name"] for volume in volumes} == mounted
        used |= {volume["persistentVolumeClaim"]["claimName"] for volume in volumes if "emptyDir" not in volume}
    assert used == claims
    index = one(documents, "PersistentVolumeClaim", "hereabouts-index")
    assert index["spec"]["accessModes"] == ["ReadWriteMany"], "one writes, many read"


@pytest.mark.parametrize("layer", LAYERS)
def test_every_variable_is_a_setting(layer) -> None:
    documents = built(layer)
    kubernetes = [variable["name"] for each in containers(documents) for variable in each.get("env", ())]
    compose = [
        pair.partition("=")[0] for service in COMPOSE[layer] for pair in SERVICES[service].get("environment", ())
    ]
    fields = set(Settings.model_fields) | OF_MILVUS
    assert {variable.removeprefix("HEREABOUTS_").lower() for variable in kubernetes + compose} <= fields
    assert set(compose) <= set(kubernetes)
    secret = [variable for variable in api(layer)["env"] if re.search("KEY|TOKEN", variable["name"])]
    assert secret
    assert all(variable["valueFrom"]["secretKeyRef"]["optional"] for variable in secret), "no value in a file"


def test_there_are_as_many_workers_as_cpus() -> None:
    container = api("base")
    [workers] = [variable for variable in container["env"] if variable["name"] == "HEREABOUTS_WORKERS"]
    assert workers["valueFrom"] == {"resourceFieldRef": {"resource": "limits.cpu"}}
    limits, requests = container["resources"]["limits"], container["resources"]["requests"]
    assert limits["cpu"].isdigit(), "a part of one would be rounded up to a worker"
    assert requests["cpu"] == limits["cpu"], "the autoscaler's share is of what is requested"


def test_probes_ask_what_is_there_and_open() -> None:
    routes = {route.path: route for route in create_app(Settings()).state.routes if "GET" in route.methods}
    container = api("base")
    [port] = container["ports"]
    for probe in PROBES:
        request = container[probe]["httpGet"]
        assert routes[request["path"]].openapi_extra == OPEN, "a probe has no key"
        assert request["port"] == port["name"]
    assert port["containerPort"] == int(option(command_of("CMD"), "--port"))
    assert one(built("base"), "Service")["spec"]["ports"][0]["targetPort"] == port["name"]
    policy = one(built("base"), "NetworkPolicy")["spec"]
    assert policy["ingress"] == [{"ports": [{"protocol": "TCP", "port": port["containerPort"]}]}]


def test_a_pod_without_an_index_that_it_can_use_gets_no_requests_and_is_left_running() -> None:
    def fail() -> None:
        raise IndexMismatch("of another model")

    with TestClient(create_app(Settings(), fail)) as client:
        got = {probe: client.get(api("base")[probe]["httpGet"]["path"]).status_code for probe in PROBES}
    assert got == {"startupProbe": 200, "livenessProbe": 200, "readinessProbe": 503}


@pytest.mark.parametrize("layer", LAYERS)
def test_a_stop_waits_for_the_endpoints_and_the_longest_request(layer) -> None:
    pods = pods_of(one(built(layer), "Deployment"))["spec"]
    waits = api(layer)["lifecycle"]["preStop"]["exec"]["command"]
    composed = int(SERVICES[COMPOSE[layer][1]]["stop_grace_period"].removesuffix("s"))
    assert waits[0] == "sleep"
    assert pods["terminationGracePeriodSeconds"] == int(waits[1]) + composed
    assert composed > MAX_DEADLINE_MS / 1000 + CLOSING_S
    assert one(built(layer), "Deployment")["spec"]["strategy"]["rollingUpdate"]["maxUnavailable"] == 0


@pytest.mark.parametrize("layer", LAYERS)
def test_pods_reach_names_and_milvus_alone(layer) -> None:
    documents = built(layer)
    for called in ("hereabouts", "hereabouts-index"):
        out = one(documents, "NetworkPolicy", called)["spec"]["egress"]
        assert [port["port"] for rule in out for port in rule["ports"]] == [53, 53] + [19530] * (layer == "milvus")
    uris = {
        each["value"] for one_of in containers(documents) for each in one_of.get("env", ()) if "URI" in each["name"]
    }
    assert all(uri.endswith(":19530") for uri in uris)
    assert len(uris) == (layer == "milvus"), "one for who writes and who reads"


def test_the_page_names_what_is_there() -> None:
    text = (DOCS / "deploy.md").read_text()
    counted = create_app(Settings(), lambda: pytest.fail("is not opened")).state.metrics.response().body.decode()
    families = set(re.findall(r"^# TYPE (hereabouts_\w+?)(?:_total)? ", counted, re.MULTILINE))
    documented = {re.sub("_(total|bucket|count)$", "", word) for word in re.findall(r"\bhereabouts_\w+", text)}
    assert documented == {family for family in families if not family.endswith("_created")}
    there = {(document["kind"].lower(), name(document)) for _, document in ALL}
    named = set(re.findall(r"\b(cronjob|deployment|job)/([\w-]+)", text)) - MADE
    assert named
    assert named <= there
    assert set(re.findall(r"docker/kubernetes/([\w.]+)", text)) == {*LAYERS, *EXTRA_FILES}
    settings = {field.upper() for field in Settings.model_fields}
    others = {field.upper() for field in OF_MILVUS | OF_FILES}
    assert settings <= set(re.findall(r"HEREABOUTS_(\w+)", text)) <= settings | others
