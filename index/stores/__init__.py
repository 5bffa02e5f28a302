"""Stores of cell vectors: `store` is the interface, `faiss_store` and `milvus_store` implement it.

Only this package imports faiss and pymilvus.
"""
