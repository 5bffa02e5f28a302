"""Delivery: the HTTP service and the command line. No arithmetic and no model code here.

`main` puts the service together, `server` runs and drains it, `settings` are what an operator can set, `logs` and
`threads` prepare a process; benchmark/ measures seconds and memory, http/, jobs/, cli/, and web/ with the page. May
import index and models; nothing imports app. FastAPI, uvicorn and typer are at home here alone.
"""
