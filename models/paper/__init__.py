"""MNCL and the methods it compares with: encoders, scene graph and losses, one file for each method; `fine/` stages."""
