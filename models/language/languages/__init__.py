"""Languages as tables: how each says where things are; one reader for all of them."""
