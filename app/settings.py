"""Settings from the environment (HEREABOUTS_PORT=9000) or the command line."""

import re
from ipaddress import IPv4Address, IPv6Address, ip_address, ip_network
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BeforeValidator, Field, PositiveInt, SecretStr, ValidationError, field_validator
from pydantic_settings import BaseSettings, NoDecode, SettingsConfigDict

from models.errors import HereaboutsError

if TYPE_CHECKING:
    from index.answering.localizer import Localizer

_KEY = re.compile(r"[!-~]{8,}")  # characters that every client and proxy can send in a header
_ORIGIN = re.compile(r"\*|https?://[^\s/?#,]+")
ROOT_PATH = re.compile(r"(/[A-Za-z0-9_][A-Za-z0-9._~-]*)*")  # without a host, which "//" would begin


def _split(value: Any) -> Any:
    """Return the items of a list with commas."""
    return [item.strip() for item in value.split(",") if item.strip()] if isinstance(value, str) else value


Items = Annotated[tuple[str, ...], NoDecode, BeforeValidator(_split)]


class Settings(BaseSettings):
    """The settings of the service; docs/deploy.md lists them. Fixed limits are in app.limits."""

    model_config = SettingsConfigDict(env_prefix="HEREABOUTS_", hide_input_in_errors=True)  # one is a secret

    index_dir: Path = Field(Path("data/index"), description="directory that `hereabouts index` wrote")
    weights_dir: Path | None = Field(None, description="weights of the retriever; None: the shipped ones")
    fine_weights_dir: Path | None = Field(
        None, description="weights of a fine stage, for refine regressor or matching; None: the shipped ones"
    )
    posterior_weights_dir: Path | None = Field(None, description="weights of the posterior; None: the shipped ones")
    host: str = "127.0.0.1"
    port: int = Field(8000, ge=0, le=65535)
    read_key: SecretStr | None = Field(
        None, description="the key that requests need; None: no key, and only direct local requests may evaluate"
    )
    root_path: str = Field("", description="path at which a reverse proxy serves the service, for example /hereabouts")
    proxies: Items = Field(
        (), description="addresses or networks of the reverse proxies whose X-Forwarded headers are used"
    )
    cors_origins: Items = Field(
        (), description="origins whose web pages may use the service, for example https://town.example; *: all"
    )
    workers: PositiveInt | None = Field(None, description="worker processes; None: one per CPU")
    max_wait_ms: PositiveInt = Field(
        1500, description="longest expected wait for a worker; a request that would wait longer gets 429"
    )
    data_dir: Path | None = Field(None, description="directory of the data sets for POST /evaluate; None: no data sets")
    jobs_dir: Path | None = Field(
        None, description="directory that keeps evaluations over restarts; None: they end with the service"
    )
    corrections_file: Path | None = Field(
        None, description="file to which POST /corrections appends; None: corrections are refused"
    )
    log_level: Literal["debug", "info", "warning", "error"] = "info"
    log_descriptions: bool = Field(
        False, description="whether to log descriptions and messages of internal errors, which may quote them"
    )

    @property
    def weights(self) -> tuple[Path | None, Path | None, Path | None]:
        """The directories of the weights in the order of `Localizer.open`."""
        return self.weights_dir, self.fine_weights_dir, self.posterior_weights_dir

    @field_validator("read_key")
    @classmethod
    def _key_can_be_sent(cls, key: SecretStr | None) -> SecretStr | None:
        if key is not None and not _KEY.fullmatch(key.get_secret_value()):
            raise ValueError(
                "must have 8 or more ASCII characters and no white space, for example the output of "
                "`openssl rand -hex 16`; without this setting the service is open"
            )
        return key

    @field_validator("root_path")
    @classmethod
    def _is_path(cls, path: str) -> str:
        path = path.rstrip("/")
        if not ROOT_PATH.fullmatch(path):
            raise ValueError("must be a path such as /hereabouts, of letters, digits and ._~-")
        return path

    @field_validator("proxies")
    @classmethod
    def _are_networks(cls, proxies: tuple[str, ...]) -> tuple[str, ...]:
        for proxy in proxies:
            try:
                ip_network(proxy)
            except ValueError:
                raise ValueError("must be addresses or networks such as 127.0.0.1,10.0.0.0/8") from None
        return proxies

    @field_validator("cors_origins")
    @classmethod
    def _are_origins(cls, origins: tuple[str, ...]) -> tuple[str, ...]:
        if not all(map(_ORIGIN.fullmatch, origins)):
            raise ValueError("must be origins such as https://town.example or http://localhost:3000, without a path")
        return origins


def load_settings(**overrides: object) -> Settings:
    """Load settings from the environment; arguments override it. HereaboutsError names an invalid setting."""
    try:
        return Settings.model_validate(overrides)
    except ValidationError as error:
        problems = "; ".join(
            f"{'.'.join(map(str, item['loc'])) or 'settings'}: {item['msg']}" for item in error.errors()
        )
        raise HereaboutsError(f"{problems}; correct the option or the HEREABOUTS_ variable of that name") from None


def open_index(index_dir: Path) -> "Localizer":
    """Open an index with the weights of the settings."""
    from index.answering.localizer import Localizer  # noqa: PLC0415  # imports torch, which takes seconds

    return Localizer.open(index_dir, *load_settings().weights)


def is_local(host: str) -> bool:
    """Return whether a host name or address is the loopback interface of this machine."""
    address = address_of(host)
    if isinstance(address, IPv6Address) and address.ipv4_mapped is not None:
        address = address.ipv4_mapped  # an IPv4 client of a dual-stack socket
    return host == "localhost" if address is None else address.is_loopback


def address_of(host: str) -> IPv4Address | IPv6Address | None:
    """Return a host as an address; None if it is a name."""
    try:
        return ip_address(host)
    except ValueError:
        return None
