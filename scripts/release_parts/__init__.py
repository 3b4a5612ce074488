"""The parts of scripts/release, one idea a file."""
