from pydantic import TypeAdapter

from api_schemas.members import Texture
from api_schemas.solid import flat_parts

IMAGE = {"technique": "image", "asset": "0" * 64}
PERLIN = {"technique": "perlin"}


def flat(body):
    texture = TypeAdapter(Texture).validate_python(body)
    return [(place, part.technique) for place, part in flat_parts(texture, "/texture")]


def test_a_solid_texture_of_solid_textures_has_no_flat_part():
    assert flat({"technique": "mix", "a": PERLIN, "b": PERLIN, "amount": PERLIN}) == []


def test_every_flat_part_is_told_with_its_place():
    body = {"technique": "mix", "a": IMAGE, "b": {"technique": "levels", "input": IMAGE}}

    assert flat(body) == [("/texture/a", "image"), ("/texture/b/input", "image")]
    assert flat(IMAGE) == [("/texture", "image")]
