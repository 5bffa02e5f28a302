"""An index directory elsewhere, behind a URL: in a bucket, on a share, on a web server."""
