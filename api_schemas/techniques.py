"""What the service can do, told by itself."""

from pydantic import Field, JsonValue

from api_schemas.base import Link, Schema


class TechniqueSummary(Schema):
    """One technique in a list."""

    name: str = Field(description="What to write as `technique`.")
    summary: str = Field(description="What it does, in one sentence.")
    link: Link = Field(description="All about it.")


class Family(Schema):
    """Techniques that may stand in each other's place."""

    family: str = Field(description="The family's name.")
    techniques: list[TechniqueSummary] = Field(description="Its members, by name.")
    link: Link = Field(description="This family.")


class Families(Schema):
    """Everything there is."""

    families: list[Family] = Field(description="All families.")


class Technique(Schema):
    """One technique, with all one needs to use it."""

    family: str = Field(description="Where it may stand.")
    name: str = Field(description="What to write as `technique`.")
    description: str = Field(description="What it does.")
    source: str = Field(description="Author and year of the idea.")
    equation: str = Field(description="The formula in plain text, where there is one.")
    revision: int = Field(description="Raised whenever the same parameters give other pixels.")
    sized: bool | None = Field(
        description="For textures: whether it has a size of its own in pixels, or is a function "
        "on the unit tile."
    )
    solid: bool | None = Field(
        description="For textures: whether it fills space, too, if the textures in it do."
    )
    parameters: dict[str, JsonValue] = Field(
        description="JSON Schema of its parameters, complete with $defs."
    )
    examples: list[dict[str, JsonValue]] = Field(description="Whole request bodies that use it.")
