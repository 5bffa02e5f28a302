"""The user interfaces: the HTTP service with its workers and jobs, the command line and the web page.

`main.create_app` and the command line compose everything. FastAPI, uvicorn and typer are imported only here.
"""
