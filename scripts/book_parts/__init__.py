"""The parts of scripts/book, one kind of page a file."""
