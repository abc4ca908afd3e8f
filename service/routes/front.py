"""The front door for people."""

from fastapi import APIRouter
from starlette.responses import RedirectResponse

router = APIRouter(include_in_schema=False)


@router.get("/")
async def front() -> RedirectResponse:
    """Leads to the documentation."""
    return RedirectResponse("/docs")
