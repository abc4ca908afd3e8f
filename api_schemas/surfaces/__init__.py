"""How surfaces reflect and emit light; adding a module adds the technique."""
