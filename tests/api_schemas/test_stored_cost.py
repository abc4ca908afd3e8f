"""What tables for filters take, and which pictures are too large for them."""

import pytest

from api_schemas.asset_use import misuses
from api_schemas.assets import ASSET_FACTS
from api_schemas.estimate import estimate
from api_schemas.requests import RenderRequest

ASSET = "a" * 64


def request(filter_name: str, **more):
    mapped = {"texture": {"technique": "image", "asset": ASSET}, "filter": filter_name, **more}
    node = {"mesh": {"type": "plane"}, "surface": {"technique": "unlit", "color": mapped}}
    return RenderRequest.model_validate({"scene": {"nodes": [node]}, "output": {"size": [64, 64]}})


def facts(width: int, height: int):
    told = {
        "kind": "image",
        "format": "png",
        "media_type": "image/png",
        "width": width,
        "height": height,
        "channels": 3,
        "bits": 8,
        "float": False,
        "has_alpha": False,
        "sha256": ASSET,
        "bytes": 1,
    }
    return {ASSET: ASSET_FACTS.validate_python(told)}


@pytest.mark.parametrize("filter_name", ["ripmap", "summed_area"])
def test_t41_a_table_has_a_largest_side(filter_name: str) -> None:
    # A ripmap of n texels is 2 n + 2 log2 n wide; a sum has two floats, on top of each other.
    pointer = "/scene/nodes/0/surface/color/texture/asset"

    assert not list(misuses(request(filter_name), facts(8180, 8180)))
    for size in ((8181, 10), (10, 8181)):
        (found,) = misuses(request(filter_name), facts(*size))
        assert (found.code, found.pointer) == ("asset_too_large", pointer)
    assert not list(misuses(request("ewa"), facts(16384, 4096)))


def test_t41_a_mirrored_sum_is_twice_as_tall() -> None:
    mirrored = request("summed_area", wrap=["repeat", "mirror"])

    assert not list(misuses(mirrored, facts(8180, 4090)))
    assert [found.code for found in misuses(mirrored, facts(100, 4091))] == ["asset_too_large"]


def test_t41_tables_take_more_memory_and_slow_filters_more_time() -> None:
    known = facts(4096, 4096)
    cost = {
        name: estimate(request(name), known)
        for name in ("trilinear", "anisotropic", "ripmap", "summed_area", "ewa")
    }
    mirrored = estimate(request("summed_area", wrap=["mirror", "mirror"]), known)
    kaiser = estimate(request("trilinear", pyramid="kaiser"), known)

    # A ripmap holds 4 texels for each one, of 16 bytes, and levels 4 / 3.
    assert cost["ripmap"].bytes > cost["trilinear"].bytes + 4096**2 * 16 * 2
    assert mirrored.bytes > cost["summed_area"].bytes + 4096**2 * 16 * 6
    assert kaiser.seconds > cost["trilinear"].seconds + 1
    large = {
        name: estimate(
            request(name).model_copy(
                update={"output": request(name).output.model_copy(update={"size": [2048, 2048]})}
            ),
            known,
        ).seconds
        for name in cost
    }
    assert large["trilinear"] < large["anisotropic"] < large["ewa"]


def test_t41_a_picture_in_two_forms_is_made_once_and_kept_twice() -> None:
    both = request("trilinear").model_dump(mode="json")
    other = request("ripmap").model_dump(mode="json")["scene"]["nodes"]
    both["scene"]["nodes"] += other
    known = facts(4096, 4096)

    one, two = (
        estimate(RenderRequest.model_validate(body), known)
        for body in (request("trilinear").model_dump(mode="json"), both)
    )

    assert two.bytes > one.bytes + 4096**2 * 60
    assert two.seconds < one.seconds + 4096**2 * 3e-7
