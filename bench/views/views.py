"""How often random views are drawn once, and whether what was promised holds.

    bench/views/views.py SPLOTCHCL FOLDER [SNAPSHOT...] [--views N] [--seed N] [--judge]

Views of made-up universes, clusters, haloes and the snapshots that are named, from random places, of
brightnesses over four decades, tolerances from 1e-2 to 1e-4, and every kind of light. FOLDER keeps the
made-up snapshots. With --judge a square of each picture, as drawn and as displayed, is compared with the
reference's. Both take the exposure that the whole picture found, and no bloom, which would need all of it.
Prints a line for each view and a summary; exit code 1 if a promise was broken.
"""

import argparse
import json
import os
import random
import subprocess
import sys
import tomllib

SQUARE = 32  # pixels that are judged along each side
LIGHTS = ("emission", "proportional", "gray", "apart", "stars")


def run(*command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stderr}")
    return done


def made_up(program, folder):
    """(kind, particles) of snapshots, large ones among them: slabs are for half a million particles and more."""
    snapshots = []
    for number, (kind, particles) in enumerate(
        (kind, particles) for particles in (20_000, 150_000, 900_000) for kind in ("universe", "cluster", "halo")
    ):
        path = os.path.join(folder, f"{kind}_{particles}")
        if not os.path.exists(path):
            run(program, "generate", kind, "-o", path, "--particles", particles, "--seed", number + 1, "-q")
        snapshots.append(path)
    return snapshots


def scene_of(program, snapshot):
    """The scene that the program chooses of a snapshot."""
    return tomllib.loads(run(program, "render", snapshot, "--explain").stdout)


def random_view(scene, dice):
    """Settings of a random view of the scene."""
    camera, settings = scene["camera"], {}
    eye, middle = camera["position"], camera["look_at"]
    distance = sum((a - b) ** 2 for a, b in zip(eye, middle)) ** 0.5
    reach = 0.12 * distance
    target = [m + dice.uniform(-reach, reach) for m in middle]
    away = [dice.gauss(0, 1) for _ in range(3)]
    length = sum(a * a for a in away) ** 0.5
    far = distance * 10 ** dice.uniform(-0.6, 0.3)
    settings["camera.look_at"] = target
    settings["camera.position"] = [t + far * a / length for t, a in zip(target, away)]
    settings["camera.field_of_view"] = 10 ** dice.uniform(0.8, 1.8)
    settings["image.size"] = [dice.randrange(160, 640), dice.randrange(160, 480)]
    settings["tolerance"] = 10 ** dice.uniform(-4, -2)
    light = dice.choice(LIGHTS)
    factor = 10 ** dice.uniform(-2, 2)
    absorbed = 10 ** dice.uniform(-1.5, 1)
    for number, component in enumerate(scene["component"]):
        key = f"component.{component['name']}."
        brightness = factor * component.get("brightness", 1) * 10 ** dice.uniform(-0.5, 0.5)
        settings[key + "brightness"] = brightness
        if light == "gray":
            settings[key + "gray_absorption"] = absorbed
        elif light == "proportional":
            settings[key + "absorption"] = "emission"
        elif light == "apart":
            settings[key + "absorption"] = brightness * absorbed * (number + 1)
        elif light == "stars":
            settings[key + "absorption"] = "none" if number else brightness * absorbed
    if dice.random() < 0.15:
        settings |= {"kernel.width": 0.41314, "kernel.cut": 1.8153652, "kernel.sampling": "center"}
    return light, settings


def arguments(settings):
    return [part for key, value in settings.items() for part in ("--set", f"{key}={json.dumps(value)}")]


def draw(program, scene, settings, picture):
    statistics = picture + ".json"
    run(program, "render", scene, "-q", "-o", picture, "--stats", statistics, *arguments(settings))
    with open(statistics, encoding="utf-8") as file:
        return json.load(file)


def finish_of(found):
    """The tone that the whole picture found, for parts of it to be finished alike."""
    return {f"finish.{key}": value for key, value in found["finish"].items()} | {"finish.bloom": 0}


def errors_of(program, snapshot, settings, folder, dice):
    """The largest errors in a random square of the picture, as drawn and as displayed, over the tolerance."""
    width, height = settings["image.size"]
    corner = [dice.randrange(size - SQUARE) for size in (width, height)]
    crop = ",".join(map(str, [*corner, SQUARE, SQUARE]))
    pictures = [os.path.join(folder, name) for name in ("square.exr", "reference.exr")]
    errors = []
    for light in ([], ["--display"]):
        for picture, extra in zip(pictures, ([], ["--reference"])):
            asked = ["-q", "--crop", crop, "-o", picture, *light, *extra, *arguments(settings)]
            run(program, "render", snapshot, *asked)
        found = run(program, "compare", "--json", *pictures)
        errors.append(json.loads(found.stdout)["worst"]["measure"] / settings["tolerance"])
    return errors


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("snapshots", nargs="*")
    parser.add_argument("--views", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--judge", action="store_true")
    asked = parser.parse_args()
    os.makedirs(asked.folder, exist_ok=True)
    snapshots = made_up(asked.program, asked.folder) + asked.snapshots
    scenes = {path: scene_of(asked.program, path) for path in snapshots}
    once, broken, worst, entries, by_light = 0, 0, 0, 0, {}
    picture = os.path.join(asked.folder, "view.exr")
    for number in range(asked.views):
        dice = random.Random(asked.seed * 1_000_003 + number)
        snapshot = dice.choice(snapshots)
        light, settings = random_view(scenes[snapshot], dice)
        found = draw(asked.program, snapshot, settings, picture)
        errors = found["check"]["errors_of_promise"]
        is_once = len(errors) == 1
        once += is_once
        entries += found["tile_entries"]
        of_light = by_light.setdefault(light, [0, 0])
        of_light[0] += is_once
        of_light[1] += 1
        line = f"{number:4} {os.path.basename(snapshot):22} {light:13} {settings['tolerance']:.1e} {[float(f'{e:.3g}') for e in errors]}"
        if asked.judge:
            measured = errors_of(asked.program, snapshot, settings | finish_of(found), asked.folder, dice)
            broken += max(measured) > 1
            worst = max(worst, *measured)
            line += " measured {:.3f}, displayed {:.3f}".format(*measured)
        print(line, flush=True)
    print(f"drawn once: {once} of {asked.views}; by light: {by_light}; entries {entries / 1e6:.1f} M")
    if asked.judge:
        print(f"broken: {broken}; largest error {worst:.3f} of the tolerance")
    sys.exit(1 if broken else 0)


if __name__ == "__main__":
    main()
