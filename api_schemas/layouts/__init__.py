"""How all directions lie on one picture; adding a module adds the technique."""
