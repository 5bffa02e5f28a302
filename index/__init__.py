"""From models to answers: build an index, open it, localize, evaluate. No HTTP here."""
