"""Writes tests/policy/freeze/models/logits.json: what PyTorch computes with networks of other shapes than 64-64.

usage: /usr/bin/python3 tests/oracles/freeze/network_logits.py tests/policy/freeze/models
needs: Debian's python3-torch; the models of make_models.py

relu.zip, three_layers.zip   the actors of these models
wide_tanh, wide_relu         three layers of 256 units; network_logits_test.cpp repeats their weights (`weight` below)

Each has one row of logits, as float64 computes them, for each of the observations of `observation`, which are those
of make_models.py.
"""

import io
import json
import sys
import zipfile
from pathlib import Path

import torch
from uniform import uniform

OBSERVATIONS, OBSERVATION_SIZE = 50, 6
WIDE = (OBSERVATION_SIZE, 256, 256, 256, 8)


def observation(i: int) -> list[float]:
    return [3.0 * uniform(element, i) - 1.5 for element in range(OBSERVATION_SIZE)]


def weight(layer: int, place: int, inputs: int) -> float:
    """Of a layer, row by row, the biases last: in [-2, 2) / s, s the least power of two with s^2 >= `inputs`.

    Exact in a float.
    """
    scale = 1
    while scale * scale < inputs:
        scale *= 2
    return 4.0 * (uniform(100 + layer, place) - 0.5) / scale


def wide(activation: type[torch.nn.Module]) -> torch.nn.Sequential:
    layers = []
    for layer, (inputs, outputs) in enumerate(zip(WIDE, WIDE[1:], strict=False)):
        dense = torch.nn.Linear(inputs, outputs).double()
        weights = [weight(layer, place, inputs) for place in range(outputs * (inputs + 1))]
        numbers = torch.tensor(weights, dtype=torch.float64)
        dense.weight.data = numbers[: outputs * inputs].reshape(outputs, inputs)
        dense.bias.data = numbers[outputs * inputs :]
        layers += [dense, activation()]
    return torch.nn.Sequential(*layers[:-1])


def of_model(file: Path, activation: type[torch.nn.Module]) -> torch.nn.Sequential:
    with zipfile.ZipFile(file) as archive:
        state = torch.load(io.BytesIO(archive.read("policy.pth")))
    names = sorted({name.rsplit(".", 1)[0] for name in state if name.startswith("mlp_extractor.policy_net.")})
    layers = []
    for name in [*names, "action_net"]:
        values = state[f"{name}.weight"]
        dense = torch.nn.Linear(values.shape[1], values.shape[0]).double()
        dense.weight.data = values.double()
        dense.bias.data = state[f"{name}.bias"].double()
        layers += [dense, activation()]
    return torch.nn.Sequential(*layers[:-1])


def main() -> None:
    folder = Path(sys.argv[1])
    networks = {
        "relu.zip": of_model(folder / "relu.zip", torch.nn.ReLU),
        "three_layers.zip": of_model(folder / "three_layers.zip", torch.nn.Tanh),
        "wide_tanh": wide(torch.nn.Tanh),
        "wide_relu": wide(torch.nn.ReLU),
    }
    seen = torch.tensor([observation(i) for i in range(OBSERVATIONS)], dtype=torch.float64)
    lines = []
    for name, network in networks.items():
        with torch.no_grad():
            rows = [[round(logit, 9) for logit in row] for row in network(seen).tolist()]
        lines.append(f'"{name}": {json.dumps(rows)}')
    (folder / "logits.json").write_text("{\n" + ",\n".join(lines) + "\n}\n")


if __name__ == "__main__":
    main()
