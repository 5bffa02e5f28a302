"""The offline job that makes an index, and the index directory: versions, their manifests and the alias file."""
