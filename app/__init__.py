"""Delivery: the HTTP service, its workers and jobs, the command line and the page.

`main.create_app` and the command line put everything together. FastAPI, uvicorn and typer are imported only here.
"""
