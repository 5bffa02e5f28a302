"""Facts about an index that do not depend on who built it."""

from index.build.artifact import open_version

OF_A_BUILD = {"version", "created"}


def index_facts(root):
    """The manifest of the version that is served, with the sums of its files."""
    return open_version(root)[1].model_dump(exclude=OF_A_BUILD)
