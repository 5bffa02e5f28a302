"""Saving and loading of retrievers."""

from models.checkpoint import SHIPPED_WEIGHTS_DIR, Checkpoints
from models.paper.mncl import Mncl
from models.paper.ret import Ret
from models.paper.retriever import Retriever
from models.paper.text2loc import Text2Loc
from models.paper.text2pos import Text2Pos

METHODS: dict[str, type[Retriever]] = {"text2pos": Text2Pos, "ret": Ret, "text2loc": Text2Loc, "mncl": Mncl}
RETRIEVERS = Checkpoints(
    "retriever",
    METHODS,
    SHIPPED_WEIGHTS_DIR / "retriever",
    "train weights with 'hereabouts train', or reinstall the package",
)
save_retriever, load_retriever = RETRIEVERS.save, RETRIEVERS.load
