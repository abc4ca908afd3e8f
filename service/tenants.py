"""Whose request it is. Everything belongs to somebody; until there are keys, to "local"."""

from typing import Annotated

from fastapi import Depends


async def tenant() -> str:
    """Return the tenant of a request."""
    return "local"


Tenant = Annotated[str, Depends(tenant)]
