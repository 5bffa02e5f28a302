"""Saving and loading retrievers."""

from models.checkpoint import SHIPPED, Checkpoints
from models.retrieval.mncl import Mncl
from models.retrieval.ret import Ret
from models.retrieval.retriever import Retriever
from models.retrieval.text2loc import Text2Loc
from models.retrieval.text2pos import Text2Pos

METHODS: dict[str, type[Retriever]] = {"text2pos": Text2Pos, "ret": Ret, "text2loc": Text2Loc, "mncl": Mncl}
RETRIEVERS = Checkpoints(
    "retriever", METHODS, SHIPPED / "retriever", "train some with 'hereabouts train', or take a fresh copy"
)
save_retriever, load_retriever = RETRIEVERS.save, RETRIEVERS.load
