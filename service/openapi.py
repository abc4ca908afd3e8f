"""`python -m service.openapi` writes openapi.json, the document that the repository keeps."""

from pathlib import Path

from service.app import create_app
from service.openapi_document import canonical
from service.settings import Settings

FILE = Path(__file__).parents[1] / "openapi.json"


def main() -> None:
    """Write the document of the present code."""
    FILE.write_text(canonical(create_app(Settings())), "utf-8")


if __name__ == "__main__":
    main()
