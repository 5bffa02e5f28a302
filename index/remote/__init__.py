"""An index directory elsewhere, behind a URL: in a bucket, on a share, on a web server.

`place` reads and writes it, `copy` keeps a local copy of what its aliases name, from which the service answers, `push`
sends an index there. May import index.build.artifact, index.build.manifest, and the errors and files of models. fsspec is at home
here.
"""
