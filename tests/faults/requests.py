"""What is asked for: quick textures, slower ones, and pictures of scenes."""

import json
import random
from dataclasses import dataclass
from typing import Any

from tests.running_service import ROOT

SODA_CAN = ROOT / "api_schemas" / "examples" / "renders" / "soda_can.json"


@dataclass(frozen=True, slots=True)
class Asked:
    """One request; `key` makes it harmless to send again."""

    key: str
    path: str
    body: dict[str, Any]


def mixed(seed: int, count: int) -> list[Asked]:
    """Return so many requests in an order of the seed; no two are for the same picture."""
    choose = random.Random(seed)
    makers = [_quick] * 12 + [_noise] * 5 + [_slow] * 2 + [_scene]
    made = [choose.choice(makers)(number) for number in range(count)]
    return [
        Asked(
            f"{seed}-{number}", path, body | {"priority": choose.choice(["interactive", "batch"])}
        )
        for number, (path, body) in enumerate(made)
    ]


def _texture(technique: dict[str, Any], side: int) -> tuple[str, dict[str, Any]]:
    return "/v1/textures", {"texture": technique, "output": {"size": [side, side]}}


def _quick(number: int) -> tuple[str, dict[str, Any]]:
    return _texture({"technique": "checkerboard", "cells": [1 + number % 16, 2]}, 16 + number)


def _noise(number: int) -> tuple[str, dict[str, Any]]:
    return _texture({"technique": "perlin", "seed": number, "octaves": 6}, 512)


def _slow(number: int) -> tuple[str, dict[str, Any]]:
    return _texture({"technique": "perlin", "seed": number, "octaves": 12}, 3000)


def _scene(number: int) -> tuple[str, dict[str, Any]]:
    body = json.loads(SODA_CAN.read_text())
    return "/v1/renders", body | {"output": {"size": [128, 96 + number]}}
