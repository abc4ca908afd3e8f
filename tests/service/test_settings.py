import pytest
from pydantic import ValidationError

from service.settings import Settings


def test_every_setting_says_why_its_default_is_what_it_is():
    for name, field in Settings.model_fields.items():
        assert field.description, name
        assert len(field.description.split(". ")) >= 2, name


def test_the_environment_decides(monkeypatch):
    monkeypatch.setenv("TEXLOOM_SLOTS", "5")
    monkeypatch.setenv("TEXLOOM_CORS_ORIGINS", "https://a.example, https://b.example")
    settings = Settings()

    assert settings.slots == 5
    assert settings.cors_origins == ("https://a.example", "https://b.example")


@pytest.mark.parametrize(
    ("name", "value"),
    [("PORT", "70000"), ("SLOTS", "0"), ("GL", "metal"), ("COST_LIMIT_SECONDS", "-1")],
)
def test_a_setting_out_of_range_is_refused(monkeypatch, name, value):
    monkeypatch.setenv(f"TEXLOOM_{name}", value)

    with pytest.raises(ValidationError):
        Settings()
