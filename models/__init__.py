"""What the world is and what is learned: the city model, language, retrieval, localization, training."""
