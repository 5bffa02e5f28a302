"""Fine stages, from hints and a candidate cell to a position in it: Text2Pos's matching and Text2Loc's regressor."""
