"""Pictures: the one pixel type, its colour, its pyramids, and files at the border."""
