"""The command line: `main` has index, serve, verify, mcp and localize; the other modules have the other commands.

`options` and `progress` are shared. Heavy imports are inside the commands, so that --help is fast.
"""
