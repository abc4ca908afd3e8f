import hashlib
import io

import numpy as np
import PIL.Image
import pytest
from hypothesis import given
from hypothesis import strategies as st

from api_schemas.maps import ColorMap, NormalMap, NumberMap
from api_schemas.surfaces.phong import PhongSpec
from api_schemas.textures.image import ImageSpec
from api_schemas.textures.normal_from_height import NormalFromHeightSpec
from tests.worker.models.refusals import outcome
from worker.errors import AssetMissingError, UnusableAssetError
from worker.models import pictures as model_pictures
from worker.models.obj import mtl as mtl
from worker.models.obj.surfaces import BUMP_DEPTH, Surfaces, surfaces_of


def png(pixels: object) -> bytes:
    file = io.BytesIO()
    PIL.Image.fromarray(np.array(pixels, np.uint8)).save(file, "png")
    return file.getvalue()


GREY = png([[0, 255], [80, 160]])
GREY_RGB = png([[[9, 9, 9], [99, 99, 99]]])
BLUISH = png([[[128, 128, 255], [100, 150, 240]]])
RGBA = png([[[255, 0, 0, 128]]])
FILES = {"grey.png": GREY, "grey rgb.png": GREY_RGB, "n.png": BLUISH, "a.png": RGBA}


def made(statements: str) -> Surfaces:
    library = {m.name: m for m in mtl.parse(b"newmtl m\n" + statements.encode())}
    return surfaces_of(("m",), library, FILES)


def surface(statements: str) -> PhongSpec:
    found = made(statements).surfaces[0].surface
    assert isinstance(found, PhongSpec)
    return found


def test_an_empty_material_is_the_default_phong() -> None:
    assert surface("") == PhongSpec(technique="phong")


def test_numbers_become_those_of_phong() -> None:
    found = surface("Kd 0.1 0.2 0.3\nKs 0.4 0.5 0.6\nNs 50\nKe 1 2 3\nKa 9 9 9\nillum 2\nNi 1.4")

    assert found == PhongSpec(
        technique="phong",
        diffuse_color=[0.1, 0.2, 0.3],
        specular_color=[0.4, 0.5, 0.6],
        specular_weight=1.0,
        exponent=50.0,
        emission=[1.0, 2.0, 3.0],
    )


def test_one_number_is_grey_and_what_is_out_of_bounds_is_held_within() -> None:
    assert surface("Kd 0.5").diffuse_color == [0.5, 0.5, 0.5]
    assert surface("Kd -1 1e300 0").diffuse_color == [0, pytest.approx(3.4028235e38), 0]
    assert surface("Kd nan 0 0").diffuse_color == [0.8, 0.8, 0.8]
    assert surface("Kd red").diffuse_color == [0.8, 0.8, 0.8]


@pytest.mark.parametrize("illum", ["illum 0", "illum 1"])
def test_without_the_highlight_model_there_is_no_highlight(illum: str) -> None:
    assert surface(f"Ks 1 1 1\nNs 10\n{illum}").specular_weight == 0


def test_an_exponent_of_zero_would_cover_everything() -> None:
    found = made("Ks 1 1 1\nNs 0")

    assert found.surfaces[0].surface.specular_weight == 0  # type: ignore[attr-defined]
    assert "Ns 0" in found.warnings[0]


@pytest.mark.parametrize(
    ("statements", "opacity", "mode"),
    [
        ("d 1", 1.0, "opaque"),
        ("d 0.25", 0.25, "blend"),
        ("d -halo 0.25", 0.25, "blend"),
        ("Tr 0.25", 0.75, "blend"),
        ("Tr 0", 1.0, "opaque"),
        ("d 0.5\nTr 0.9", 0.5, "blend"),
        ("d 7", 1.0, "opaque"),
        ("d -7", 0.0, "blend"),
    ],
)
def test_opacity_is_d_or_what_tr_leaves(statements: str, opacity: float, mode: str) -> None:
    found = surface(statements)

    assert found.opacity == opacity
    assert found.alpha_mode == mode


def test_tr_1_is_taken_as_meshlab_means_it() -> None:
    found = made("Tr 1.000000")

    assert found.surfaces[0].surface.alpha_mode == "opaque"
    assert found.warnings == ["material m: Tr 1 would make it invisible and is taken as opaque"]


def test_a_picture_multiplies_its_colour_and_is_srgb_without_alpha() -> None:
    found = made("Kd 0.5 0.25 1\nmap_Kd a.png")
    colour = found.surfaces[0].surface.diffuse_color  # type: ignore[attr-defined]

    sha256 = hashlib.sha256(RGBA).hexdigest()
    assert colour == ColorMap(
        texture=ImageSpec(technique="image", asset=sha256, encoding="srgb", alpha="ignore"),
        tint=[0.5, 0.25, 1.0],
    )
    assert found.pictures == {sha256: RGBA}
    assert found.surfaces[0].surface.alpha_mode == "opaque"


def test_a_picture_beside_black_stands_alone() -> None:
    found = made("Kd 0 0 0\nmap_Kd grey rgb.png")

    assert found.surfaces[0].surface.diffuse_color.tint == [1, 1, 1]  # type: ignore[attr-defined]
    assert "Kd is black" in found.warnings[0]


def test_highlights_emission_and_exponent_take_pictures() -> None:
    found = surface("map_Ks a.png\nmap_Ke n.png\nKe 2 2 2\nNs 60\nmap_Ns grey.png")

    assert isinstance(found.specular_color, ColorMap)
    assert found.specular_weight == 1
    assert isinstance(found.emission, ColorMap)
    assert found.emission.tint == [2, 2, 2]
    assert isinstance(found.exponent, NumberMap)
    assert found.exponent.scale == 60
    assert isinstance(found.exponent.texture, ImageSpec)
    assert found.exponent.texture.encoding == "linear"


@pytest.mark.parametrize(
    ("statement", "channel"),
    [
        ("map_d a.png", "a"),
        ("map_d grey.png", "r"),
        ("map_d -imfchan g a.png", "g"),
        ("map_d -imfchan m grey.png", "a"),
    ],
)
def test_opacity_is_read_from_the_alpha_a_picture_has(statement: str, channel: str) -> None:
    found = surface(f"d 0.5\n{statement}")

    assert isinstance(found.opacity, NumberMap)
    assert found.opacity.channel == channel
    assert found.opacity.scale == 0.5
    assert found.alpha_mode == "blend"


def test_options_place_and_shift_the_picture() -> None:
    found = surface("map_Kd -s 2 3 1 -o 0.5 0.25 -mm 0.1 0.8 -clamp on -blendu off grey rgb.png")

    assert isinstance(found.diffuse_color, ColorMap)
    assert found.diffuse_color.transform.scale == [2, 3]
    assert found.diffuse_color.transform.offset == [0.5, 0.25]
    assert found.diffuse_color.wrap == ["clamp", "clamp"]
    assert (found.diffuse_color.bias, found.diffuse_color.scale) == (0.1, 0.8)


def test_one_number_after_s_is_along_u_and_a_name_may_be_a_number() -> None:
    library = mtl.parse(b"newmtl m\nmap_Kd -s 2 7")
    texture = library[0].textures["map_kd"]

    assert texture.file == "7"
    assert texture.numbers("-s") == (2,)
    found = surfaces_of(("m",), {"m": library[0]}, {"7": GREY}).surfaces[0].surface
    assert found.diffuse_color.transform.scale == [2, 1]  # type: ignore[attr-defined]


@pytest.mark.parametrize("name", ["grey.png", "grey rgb.png"])
def test_a_grey_bump_is_a_relief(name: str) -> None:
    normal = surface(f"map_Bump -bm 0.5 {name}").normal

    assert isinstance(normal, NormalMap)
    assert isinstance(normal.texture, NormalFromHeightSpec)
    assert normal.texture.depth == 0.5 * BUMP_DEPTH


@pytest.mark.parametrize("statement", ["bump -bm 0.5 n.png", "norm n.png"])
def test_a_bump_with_colours_is_a_normal_map(statement: str) -> None:
    normal = surface(statement).normal

    assert isinstance(normal, NormalMap)
    assert normal.strength == (0.5 if "bm" in statement else 1)
    assert normal.green == "up"
    assert normal.texture == ImageSpec(
        technique="image", asset=hashlib.sha256(BLUISH).hexdigest(), encoding="linear"
    )


@pytest.mark.parametrize(
    ("statement", "warning"),
    [
        ("disp h.png", "disp is not drawn"),
        ("refl -type sphere r.png", "refl is not drawn"),
        ("map_Ka a.png", "map_Ka is not drawn"),
        ("map_Pr r.png", "map_Pr is not drawn"),
        ("Kd spectral file.rfl 1", "spectra or as CIE XYZ"),
        ("Kd xyz 1 1 1", "spectra or as CIE XYZ"),
        ("illum 7", "refraction"),
        ("map_Kd -t 1 1 1 a.png", "option -t"),
        ("map_Kd -boost 2 a.png", "option -boost"),
    ],
)
def test_what_is_not_drawn_is_named_and_its_pictures_are_not_needed(
    statement: str, warning: str
) -> None:
    assert any(warning in told for told in made(statement).warnings)


def test_a_picture_that_is_not_in_the_set_is_named() -> None:
    with pytest.raises(AssetMissingError, match=r"a file maps/x\.png, which") as missing:
        made("map_Kd maps\\x.png")
    assert missing.value.code == "asset_file_missing"


def test_a_picture_that_is_none_is_refused() -> None:
    library = {m.name: m for m in mtl.parse(b"newmtl m\nmap_d x.png")}

    with pytest.raises(UnusableAssetError):
        surfaces_of(("m",), library, {"x.png": b"Dear technical artist"})


def test_a_picture_that_many_materials_wear_is_decoded_once(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    decoded = []
    measure = model_pictures.measure
    monkeypatch.setattr(model_pictures, "measure", lambda c: decoded.append(c) or measure(c))
    library = {str(i): mtl.parse(b"newmtl m\nmap_d a.png")[0] for i in range(50)}

    surfaces_of(tuple(library), library, FILES)

    assert decoded == [RGBA]


def test_pictures_that_are_drawn_are_needed() -> None:
    found = mtl.parse(
        b"newmtl a\nmap_Kd .\\b c.png\nmap_Bump -bm 1 d.png\ndisp e.png\nnewmtl f\nmap_Kd b c.png"
    )

    assert mtl.needed(found) == ("b c.png", "d.png")


def test_a_library_of_more_than_four_mebibytes_is_refused() -> None:
    with pytest.raises(UnusableAssetError, match="4194305 bytes") as refusal:
        mtl.parse(b"#" * (mtl.BYTES_MAX + 1))
    assert refusal.value.code == "asset_too_large"


@given(st.binary(max_size=6), st.integers(0, 160), st.integers(0, 20))
def test_damage_is_read_or_refused_by_name(noise: bytes, at: int, cut: int) -> None:
    whole = (
        b"newmtl m\nKd 0.5 1 2\nKs 1\nNs 1e3\nd 0.5\nillum 2\nTr 0.1\n"
        b"map_Kd -s 1 2 -o 3 -mm 0 1 -clamp on a.png\nbump -bm 2 n.png\nmap_d -imfchan r grey.png\n"
    )
    obj = b"mtllib a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3"
    damaged = whole[:at] + noise + whole[at + cut :]

    named = ("read", "asset_file_missing", "asset_unusable", "asset_unsupported")
    assert outcome(obj, FILES | {"a": damaged}) in named


@given(st.text("0123456789.eE+-naif", max_size=8), st.sampled_from(["Kd", "Ns", "d", "Tr", "Ke"]))
def test_any_number_makes_a_surface_that_the_schema_accepts(word: str, statement: str) -> None:
    found = surface(f"{statement} {word}\nKs 1 1 1\nmap_Kd -s {word} -mm {word} 1 a.png")

    assert PhongSpec.model_validate_json(found.model_dump_json()) == found
