"""How fast and how large, on this machine.

`service` measures a map and an index as they are, `growth` how all of it grows with a city: `questions` are what it is
asked, `searches` the stores of vectors side by side, `plots` the pictures. `processes` starts what is measured. May
import index, what it measures with, and models.
"""
