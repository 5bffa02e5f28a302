"""MNCL and the methods it compares with: encoders, scene graph, losses, one file per method, and fine stages."""
