"""Write tests/data/scene_reference.csv: what Mitsuba 3 says of shapes, emitters and sensors.

Run `python make_scene_reference.py` where the `mitsuba` package is installed. Lines of the file:

    shape,NAME,XML             the rows that follow belong to this plugin
    light,NAME,XML             likewise: a light that is sampled
    sky,NAME,XML               likewise: a light that rays meet when they leave the scene
    sensor,NAME,XML            likewise
    filter,NAME,XML            likewise
    origin,direction,t,position,n,shading n,uv,dp_du,dp_dv    3 + 3 + 1 + 3 + 3 + 3 + 2 + 3 + 3 numbers, for a shape
    from,direction,distance,weight                    3 + 3 + 1 + 3 numbers, for a light; the distance to infinity is 0
    direction,radiance                                3 + 3 numbers, for a sky
    film,lens,origin,direction,length                 2 + 2 + 3 + 3 + 1 numbers, for a sensor
    place,value,radius                                1 + 1 + 1 numbers, for a filter, whose integral is not 1

`film` counts from the top left corner of the whole film, not of the crop window; `lens` are the numbers that give
Mitsuba's point of the lens through r = sqrt(lens[0]), phi = 2 pi lens[1].
"""

from pathlib import Path

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")
import drjit as dr  # noqa: E402

FOLDER = Path(__file__).resolve().parent.parent / "tests" / "data"
ROWS = 6

# A unit axis: Mitsuba 3.9.1 takes it as it is, and what comes out is no rotation where it is none.
TURNED = '<rotate x="0.48" y="0.6" z="-0.64" angle="50"/><translate x="0.3" y="-0.2" z="0.5"/>'
EVEN = f'<transform name="to_world"><scale value="1.4"/>{TURNED}</transform>'
PLACES = {
    "": "",
    " turned": EVEN,
    " uneven": f'<transform name="to_world"><scale x="1.3" y="0.7" z="0.9"/>{TURNED}</transform>',
    " mirrored": f'<transform name="to_world"><scale x="-1" y="1" z="1"/>{TURNED}</transform>',
}
FLIPPED = '<boolean name="flip_normals" value="true"/>'
FACETED = '<boolean name="face_normals" value="true"/>'
UPRIGHT = '<boolean name="flip_tex_coords" value="false"/>'
OVERTURNED = '<boolean name="flip_tex_coords" value="true"/>'
OBJ = '<string name="filename" value="roof.obj"/>'
PLY = '<string name="filename" value="roof.ply"/>'
CENTER = '<point name="center" x="0.2" y="0.3" z="-0.4"/><float name="radius" value="0.8"/>'
ENDS = (
    '<point name="p0" x="0.1" y="0.3" z="-0.5"/><point name="p1" x="0.4" y="-0.6" z="0.9"/>'
    '<float name="radius" value="0.6"/>'
)
# Shading follows dp_du only where it is asked for.
METAL = '<bsdf type="roughconductor"><float name="alpha_u" value="0.1"/><float name="alpha_v" value="0.4"/></bsdf>'


def shape(plugin: str, *inside: str) -> str:
    """XML of a shape."""
    return f'<shape type="{plugin}">{"".join(inside)}{METAL}</shape>'


SHAPES = {
    **{f"{name}{place}": shape(name, xml) for name in ("rectangle", "cube", "disk") for place, xml in PLACES.items()},
    **{f"{name} flipped": shape(name, FLIPPED) for name in ("rectangle", "cube", "sphere", "cylinder")},
    **{f"{name} flipped mirrored": shape(name, FLIPPED, PLACES[" mirrored"]) for name in ("rectangle", "cube", "disk")},
    "disk flipped": shape("disk", FLIPPED),
    "sphere": shape("sphere"),
    "sphere turned": shape("sphere", EVEN),
    "sphere placed": shape("sphere", CENTER),
    "sphere placed turned": shape("sphere", CENTER, EVEN),
    "sphere mirrored": shape("sphere", PLACES[" mirrored"]),
    "sphere flipped mirrored": shape("sphere", FLIPPED, PLACES[" mirrored"]),
    "cylinder": shape("cylinder"),
    "cylinder turned": shape("cylinder", EVEN),
    "cylinder placed": shape("cylinder", ENDS),
    "cylinder placed turned": shape("cylinder", ENDS, EVEN),
    "cylinder long": shape(
        "cylinder", f'<transform name="to_world"><scale x="0.4" y="0.4" z="1.7"/>{TURNED}</transform>'
    ),
    "cylinder mirrored": shape("cylinder", PLACES[" mirrored"]),
    **{
        f"{kind}{place}": shape(kind, path, xml)
        for kind, path in (("obj", OBJ), ("ply", PLY))
        for place, xml in PLACES.items()
    },
    "obj faceted": shape("obj", OBJ, FACETED),
    "obj flipped": shape("obj", OBJ, FLIPPED),
    "obj flipped faceted": shape("obj", OBJ, FLIPPED, FACETED),
    "obj upright": shape("obj", OBJ, UPRIGHT),
    "obj faceted mirrored": shape("obj", OBJ, FACETED, PLACES[" mirrored"]),
    "ply faceted": shape("ply", PLY, FACETED),
    "ply flipped": shape("ply", PLY, FLIPPED),
    "ply flipped faceted": shape("ply", PLY, FLIPPED, FACETED),
    "ply overturned": shape("ply", PLY, OVERTURNED),
    "ply flipped mirrored": shape("ply", PLY, FLIPPED, PLACES[" mirrored"]),
}

INTENSITY = '<rgb name="intensity" value="3 2 1"/>'
AIMED = '<transform name="to_world"><lookat origin="0.5 2 1" target="0.2 -0.1 0.3" up="0 0 1"/></transform>'
PICTURE = '<texture type="bitmap" name="texture"><string name="filename" value="pattern.png"/></texture>'


def light(plugin: str, *inside: str, **numbers: float) -> str:
    """XML of an emitter."""
    floats = "".join(f'<float name="{name}" value="{value}"/>' for name, value in numbers.items())
    return f'<emitter type="{plugin}">{"".join(inside)}{floats}</emitter>'


LIGHTS = {
    "point": light("point", INTENSITY, '<point name="position" x="0.1" y="2" z="-0.3"/>'),
    "point default": light("point"),
    "point moved": light(
        "point", INTENSITY, '<transform name="to_world"><translate x="0.4" y="2" z="0.5"/></transform>'
    ),
    "spot": light("spot", INTENSITY, AIMED),
    "spot wide": light("spot", INTENSITY, AIMED, cutoff_angle=60.0, beam_width=10.0),
    "spot hard": light("spot", INTENSITY, AIMED, cutoff_angle=40.0, beam_width=39.9),
    "spot textured": light("spot", INTENSITY, AIMED, PICTURE, cutoff_angle=50.0, beam_width=40.0),
    "directional": light(
        "directional", '<rgb name="irradiance" value="3 2 1"/>', '<vector name="direction" x="1" y="-2" z="0.5"/>'
    ),
    "directional default": light("directional"),
    "directional turned": light("directional", f'<transform name="to_world">{TURNED}</transform>'),
}

IMAGE = '<string name="filename" value="pattern.png"/>'
SKIES = {
    "envmap": light("envmap", IMAGE),
    "envmap scaled": light("envmap", IMAGE, scale=2.5),
    "envmap turned": light("envmap", IMAGE, f'<transform name="to_world">{TURNED}</transform>'),
    "envmap upright": light("envmap", IMAGE, '<transform name="to_world"><rotate x="1" angle="90"/></transform>'),
    "envmap mirrored": light("envmap", IMAGE, '<transform name="to_world"><scale x="-1" y="1" z="1"/></transform>'),
    "constant": light("constant", '<rgb name="radiance" value="0.3 0.2 0.1"/>'),
    "constant default": light("constant"),
}

FILM = '<film type="hdrfilm"><integer name="width" value="{}"/><integer name="height" value="{}"/>{}</film>'
WIDE, TALL = FILM.format(48, 32, ""), FILM.format(20, 50, "")
CROPPED = FILM.format(
    48,
    32,
    "".join(
        f'<integer name="crop_{k}" value="{v}"/>'
        for k, v in (("offset_x", 10), ("offset_y", 4), ("width", 16), ("height", 20))
    ),
)
CLIP = {"near_clip": 0.5, "far_clip": 20.0}
LENS = {"aperture_radius": 0.2, "focus_distance": 3.0}


def sensor(plugin: str, film: str, *inside: str, **numbers: float) -> str:
    """XML of a sensor."""
    floats = "".join(f'<float name="{name}" value="{value}"/>' for name, value in numbers.items())
    return f'<sensor type="{plugin}">{"".join(inside)}{floats}{film}</sensor>'


def axis(name: str) -> str:
    """XML of the axis that a field of view belongs to."""
    return f'<string name="fov_axis" value="{name}"/>'


AXES = ("x", "y", "diagonal", "smaller", "larger")
SCALED = (
    '<transform name="to_world"><scale x="2" y="2"/><lookat origin="1 2 3" target="0 0.5 0" up="0 1 0"/></transform>'
)
SENSORS = {
    "perspective default": sensor("perspective", WIDE),
    **{f"perspective {a}": sensor("perspective", WIDE, axis(a), AIMED, fov=50.0) for a in AXES},
    **{f"perspective tall {a}": sensor("perspective", TALL, axis(a), AIMED, fov=50.0) for a in AXES},
    "perspective cropped": sensor("perspective", CROPPED, AIMED, fov=40.0),
    "perspective shifted": sensor(
        "perspective", WIDE, AIMED, fov=40.0, principal_point_offset_x=0.1, principal_point_offset_y=-0.2
    ),
    "perspective shifted cropped": sensor(
        "perspective", CROPPED, AIMED, fov=40.0, principal_point_offset_x=0.1, principal_point_offset_y=-0.2
    ),
    "perspective clipped": sensor("perspective", WIDE, AIMED, fov=70.0, **CLIP),
    "perspective 85mm": sensor("perspective", WIDE, AIMED, '<string name="focal_length" value="85mm"/>'),
    "perspective tall 35": sensor("perspective", TALL, AIMED, '<string name="focal_length" value="35"/>'),
    "thinlens": sensor("thinlens", WIDE, AIMED, fov=50.0, **LENS),
    "thinlens default focus": sensor("thinlens", WIDE, AIMED, aperture_radius=0.3),
    "thinlens clipped": sensor("thinlens", TALL, AIMED, axis("larger"), fov=50.0, **LENS, **CLIP),
    "thinlens cropped": sensor("thinlens", CROPPED, AIMED, fov=40.0, **LENS),
    "orthographic": sensor("orthographic", WIDE, SCALED),
    "orthographic default": sensor("orthographic", TALL),
    "orthographic cropped": sensor("orthographic", CROPPED, SCALED, **CLIP),
}


FILTERS = {
    name: f'<rfilter type="{name}"/>' for name in ("box", "catmullrom", "gaussian", "lanczos", "mitchell", "tent")
} | {
    "gaussian wide": '<rfilter type="gaussian"><float name="stddev" value="0.8"/></rfilter>',
    "lanczos two": '<rfilter type="lanczos"><integer name="lobes" value="2"/></rfilter>',
    "mitchell sharp": '<rfilter type="mitchell"><float name="B" value="0.1"/><float name="C" value="0.45"/></rfilter>',
    "tent wide": '<rfilter type="tent"><float name="radius" value="1.5"/></rfilter>',
}


def load(xml: str) -> object:
    """Build a scene of one plugin."""
    for name in ("roof.obj", "roof.ply", "pattern.png"):
        xml = xml.replace(f'value="{name}"', f'value="{FOLDER / name}"')
    return mi.load_string(f'<scene version="3.0.0">{xml}</scene>')


def numbers(*values: object) -> str:
    """One line of the file."""
    flat = [float(x) for value in values for x in np.atleast_1d(np.array(value, dtype=float))]
    return ",".join(f"{x:.7g}" for x in flat)


def unit(vector: np.ndarray) -> np.ndarray:
    """The direction of a vector, with few digits."""
    return np.round(vector / np.linalg.norm(vector), 6)


def shape_rows(scene: object, rng: np.random.Generator) -> list[str]:
    """Rays from around the shape to points near its middle."""
    rows = []
    while len(rows) < ROWS:
        origin = np.round(4 * unit(rng.normal(size=3)), 4)
        direction = unit(rng.uniform(-0.6, 0.6, size=3) - origin)
        si = scene.ray_intersect(mi.Ray3f(origin, dr.normalize(mi.Vector3f(direction))))
        if si.is_valid():
            rows.append(numbers(origin, direction, si.t, si.p, si.n, si.sh_frame.n, si.uv, si.dp_du, si.dp_dv))
    return rows


def light_rows(scene: object, rng: np.random.Generator) -> list[str]:
    """Receivers around the scene; those in the dark are kept too."""
    rows, emitter = [], scene.emitters()[0]
    for _ in range(2 * ROWS):
        it = dr.zeros(mi.SurfaceInteraction3f)
        it.p = mi.Point3f(np.round(rng.uniform(-1, 1, size=3), 4))
        sample, weight = emitter.sample_direction(it, mi.Point2f(0.3, 0.6))
        distance = 0 if "Directional" in str(emitter) else sample.dist
        rows.append(numbers(it.p, sample.d, distance, weight))
    return rows


def sky_rows(scene: object, rng: np.random.Generator) -> list[str]:
    """Directions of a ray that leaves the scene."""
    rows = []
    for _ in range(2 * ROWS):
        direction = unit(rng.normal(size=3))
        si = dr.zeros(mi.SurfaceInteraction3f)
        si.wi = -dr.normalize(mi.Vector3f(direction))
        rows.append(numbers(direction, scene.environment().eval(si)))
    return rows


def sensor_rows(scene: object, rng: np.random.Generator) -> list[str]:
    """Rays through the crop window."""
    rows, sensor = [], scene.sensors()[0]
    film = sensor.film()
    for _ in range(ROWS):
        sample, lens = rng.random((2, 2))
        ray, _ = sensor.sample_ray(0, 0.5, mi.Point2f(*sample), mi.Point2f(*lens))
        x, y = np.array(mi.warp.square_to_uniform_disk_concentric(mi.Point2f(*lens)))
        place = (np.array(film.crop_offset()) + sample * np.array(film.crop_size())) / np.array(film.size())
        rows.append(numbers(place, x * x + y * y, np.arctan2(y, x) / (2 * np.pi) % 1, ray.o, ray.d, ray.maxt))
    return rows


def filter_rows(scene: object, rng: np.random.Generator) -> list[str]:
    """Places within the radius."""
    rfilter = scene.sensors()[0].film().rfilter()
    places = np.round(rng.uniform(-1, 1, size=2 * ROWS) * rfilter.radius(), 6)
    return [numbers(x, rfilter.eval(x), rfilter.radius()) for x in places]


def main() -> None:
    """Write the file."""
    lines = [f"# Made by data/make_scene_reference.py with Mitsuba {mi.__version__} ({mi.variant()})"]
    families = (
        ("shape", SHAPES, shape_rows),
        ("light", LIGHTS, light_rows),
        ("sky", SKIES, sky_rows),
        ("sensor", SENSORS, sensor_rows),
        ("filter", FILTERS, filter_rows),
    )
    for family, members, make in families:
        for index, (name, xml) in enumerate(members.items()):
            lines.append(f"{family},{name},{xml}")
            lines += make(
                load(sensor("perspective", FILM.format(8, 8, xml)) if family == "filter" else xml),
                np.random.default_rng([index, ROWS]),
            )
    (FOLDER / "scene_reference.csv").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
