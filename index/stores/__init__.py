"""Where the vectors of cells live: `store` is what all of them can do, and a file a backend.

`faiss_store` looks into a file of the index; `milvus_store` asks a Milvus server, over `milvus_connection`, and
takes the extra `milvus`; `opening` picks the one that a manifest names. May import index.answering.query and index.build.artifact's
manifest, and the errors of models. FAISS and pymilvus are at home here.
"""
