"""What the README must not forget."""

from pathlib import Path

import pytest

from service.settings import Settings

README = (Path(__file__).resolve().parent.parent / "README.md").read_text()


@pytest.mark.parametrize("setting", Settings.model_fields)
def test_every_setting_is_in_the_readme(setting: str) -> None:
    assert f"`TEXLOOM_{setting.upper()}`" in README
