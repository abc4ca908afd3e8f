"""Which vector a map is looked up with; adding a module adds the technique."""
