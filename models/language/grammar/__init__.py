"""What only trains, validates and measures the reader: made-up facts, told in many wordings."""
