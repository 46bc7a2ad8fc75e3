"""Write tests/data/bsdf_reference.csv: values and densities of BSDFs and textures as Mitsuba 3 computes them.

Run `python make_bsdf_reference.py` where the `mitsuba` package is installed. Lines of the file:

    bsdf,NAME,XML          the rows that follow belong to this plugin
    delta,NAME,XML         likewise
    texture,NAME,XML       likewise
    wo,wi,uv,value,pdf     3 + 3 + 2 + 3 + 1 numbers, for a BSDF; wo points to the viewer (Mitsuba calls it wi)
    wo,lobe,wi,weight,pdf,eta  3 + 1 + 3 + 3 + 1 + 1 numbers, for a sample of a delta lobe
    uv,color,number,gradient   2 + 3 + 1 + 2 numbers, for a texture

All rows of BSDFs share one surface, whose frame is in `SURFACE` here and in the test that reads the file.
"""

from pathlib import Path

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")
import drjit as dr  # noqa: E402

FOLDER = Path(__file__).resolve().parent.parent / "tests" / "data"
ROWS = 16
SURFACE = {"n": (0.1, -0.05, 1.0), "dp_du": (1.1, 0.2, 0.1), "dp_dv": (-0.1, 0.9, 0.3)}


def bsdf(plugin: str, *inside: str, **parameters: object) -> str:
    """XML of a BSDF."""
    return f'<bsdf type="{plugin}">{"".join(inside)}{params(parameters)}</bsdf>'


def texture(plugin: str, *inside: str, name: str | None = None, **parameters: object) -> str:
    """XML of a texture."""
    named = f' name="{name}"' if name else ""
    return f'<texture type="{plugin}"{named}>{"".join(inside)}{params(parameters)}</texture>'


def params(parameters: dict[str, object]) -> str:
    """XML of typed parameters."""
    out = ""
    for name, value in parameters.items():
        if isinstance(value, bool):
            out += f'<boolean name="{name}" value="{str(value).lower()}"/>'
        elif isinstance(value, float):
            out += f'<float name="{name}" value="{value}"/>'
        elif isinstance(value, tuple):
            out += f'<rgb name="{name}" value="{" ".join(map(str, value))}"/>'
        else:
            out += f'<string name="{name}" value="{value}"/>'
    return out


HEIGHT = texture("bitmap", filename="height.png", raw=True)
PAINT = texture("bitmap", filename="pattern.png", name="diffuse_reflectance")
DIFFUSE = bsdf("diffuse", reflectance=(0.2, 0.5, 0.8))
BRUSHED = bsdf("roughconductor", distribution="ggx", alpha_u=0.4, alpha_v=0.15, eta=(0.2, 0.9, 1.1), k=(3.9, 2.4, 2.1))
GLASS = bsdf("roughdielectric", alpha=0.4)

BSDFS = {
    "diffuse": DIFFUSE,
    "diffuse textured": bsdf("diffuse", PAINT.replace("diffuse_reflectance", "reflectance")),
    "twosided one": bsdf("twosided", DIFFUSE),
    "twosided two": bsdf("twosided", DIFFUSE, BRUSHED),
    "roughconductor default": bsdf("roughconductor"),
    "roughconductor beckmann": bsdf("roughconductor", alpha=0.3, eta=(0.2, 0.9, 1.1), k=(3.9, 2.4, 2.1)),
    "roughconductor ggx anisotropic": BRUSHED,
    "roughconductor beckmann anisotropic": bsdf(
        "roughconductor", alpha_u=0.1, alpha_v=0.5, specular_reflectance=(0.9, 0.5, 0.3)
    ),
    "roughconductor ggx all": bsdf("roughconductor", distribution="ggx", alpha=0.5, sample_visible=False),
    "roughconductor beckmann all": bsdf("roughconductor", alpha=0.4, sample_visible=False),
    "roughdielectric default": bsdf("roughdielectric"),
    "roughdielectric ggx": bsdf("roughdielectric", distribution="ggx", alpha=0.3, int_ior="water"),
    "roughdielectric dense": bsdf("roughdielectric", distribution="ggx", alpha=0.5, int_ior=1.0, ext_ior=1.8),
    "roughdielectric all": bsdf(
        "roughdielectric", alpha=0.3, sample_visible=False, specular_transmittance=(0.5, 0.9, 0.7)
    ),
    "roughdielectric anisotropic": bsdf("roughdielectric", distribution="ggx", alpha_u=0.1, alpha_v=0.4),
    "plastic default": bsdf("plastic"),
    "plastic nonlinear": bsdf("plastic", diffuse_reflectance=(0.1, 0.2, 0.6), nonlinear=True, int_ior=1.9),
    "plastic textured": bsdf("plastic", PAINT, specular_reflectance=(0.5, 0.5, 0.2)),
    "roughplastic default": bsdf("roughplastic"),
    "roughplastic ggx": bsdf(
        "roughplastic", distribution="ggx", alpha=0.3, diffuse_reflectance=(0.1, 0.2, 0.6), nonlinear=True
    ),
    "roughplastic all": bsdf("roughplastic", alpha=0.5, sample_visible=False, int_ior=1.9),
    "roughplastic textured": bsdf(
        "roughplastic", PAINT, distribution="ggx", alpha=0.05, specular_reflectance=(0.5, 0.5, 0.2)
    ),
    "mask": bsdf("mask", DIFFUSE, opacity=0.3),
    "mask rgb": bsdf("mask", BRUSHED, opacity=(0.2, 0.4, 0.9)),
    "blendbsdf": bsdf("blendbsdf", DIFFUSE, BRUSHED, weight=0.3),
    "blendbsdf delta": bsdf("blendbsdf", bsdf("plastic"), bsdf("dielectric"), weight=0.25),
    "normalmap": bsdf("normalmap", BRUSHED, normalmap=(0.8, 0.6, 0.8)),
    "normalmap plain": bsdf(
        "normalmap", DIFFUSE, normalmap=(0.2, 0.3, 0.7), flip_invalid_normals=False, use_shadowing_function=False
    ),
    "normalmap glass": bsdf("normalmap", GLASS, normalmap=(0.8, 0.6, 0.8)),
    # Mitsuba 3.9.1 mixes world and local coordinates in the tangent of bump maps, so anisotropy is left out here.
    "bumpmap": bsdf("bumpmap", bsdf("roughconductor", alpha=0.4), HEIGHT, scale=0.4),
    "bumpmap steep": bsdf("bumpmap", DIFFUSE, HEIGHT, scale=3.0),
    "bumpmap plain": bsdf("bumpmap", DIFFUSE, HEIGHT, flip_invalid_normals=False, use_shadowing_function=False),
}

DELTAS = {
    "conductor": bsdf("conductor", eta=(0.2, 0.9, 1.1), k=(3.9, 2.4, 2.1), specular_reflectance=(0.9, 0.5, 0.3)),
    "dielectric": bsdf("dielectric", specular_reflectance=(0.9, 0.5, 0.3), specular_transmittance=(0.5, 0.9, 0.7)),
    "dielectric dense": bsdf("dielectric", int_ior=1.0, ext_ior=1.8),
    "thindielectric": bsdf("thindielectric", specular_transmittance=(0.5, 0.9, 0.7)),
    "plastic": bsdf("plastic", diffuse_reflectance=(0.1, 0.2, 0.6), specular_reflectance=(0.9, 0.5, 0.3)),
    "twosided": bsdf("twosided", bsdf("conductor")),
    "mask": bsdf("mask", bsdf("conductor"), opacity=0.3),
    "null": bsdf("null"),
}

ROTATED = (
    '<transform name="to_uv"><scale x="2.0" y="2.0"/><rotate z="1" angle="30"/><translate x="0.2" y="0.1"/></transform>'
)
STRETCHED = '<transform name="to_uv"><scale x="2.0" y="3.0"/></transform>'
TEXTURES = {
    f"bitmap {filter_type} {wrap_mode}": texture(
        "bitmap", filename="pattern.png", filter_type=filter_type, wrap_mode=wrap_mode
    )
    for filter_type in ("bilinear", "nearest")
    for wrap_mode in ("repeat", "mirror", "clamp")
} | {
    "bitmap raw": texture("bitmap", filename="pattern.png", raw=True),
    "bitmap gray": texture("bitmap", filename="height.png"),
    "bitmap stretched": texture("bitmap", STRETCHED, filename="pattern.png", raw=True),
    "bitmap rotated": texture("bitmap", ROTATED, filename="height.png", raw=True),
    "checkerboard default": texture("checkerboard"),
    "checkerboard": texture("checkerboard", ROTATED, color0=(0.1, 0.2, 0.6), color1=(0.9, 0.8, 0.1)),
}


def make_images() -> None:
    """Two tiny images with all kinds of values."""
    pattern = np.array(
        [[[(37 * (i + 5 * j) + 83 * c * c) % 256 for c in range(3)] for i in range(5)] for j in range(3)]
    )
    height = np.array([[[(97 * i + 151 * j * j + 31) % 256] for i in range(4)] for j in range(4)])
    mi.Bitmap(pattern.astype(np.uint8)).write(str(FOLDER / "pattern.png"))
    mi.Bitmap(height.astype(np.uint8)).write(str(FOLDER / "height.png"))


def load(xml: str) -> object:
    """Build a plugin of the file."""
    for name in ("pattern.png", "height.png"):
        xml = xml.replace(f'value="{name}"', f'value="{FOLDER / name}"')
    tag, rest = xml.split(" ", 1)
    return mi.load_string(f'{tag} version="3.0.0" {rest}')


def numbers(*values: object) -> str:
    """One line of the file."""
    flat = [float(x) for value in values for x in np.atleast_1d(np.array(value, dtype=float))]
    return ",".join(f"{x:.6g}" for x in flat)


def surface(wo: np.ndarray, uv: np.ndarray) -> object:
    """The interaction all BSDF rows share."""
    si = dr.zeros(mi.SurfaceInteraction3f)
    si.uv = mi.Point2f(*uv)
    si.dp_du, si.dp_dv = mi.Vector3f(SURFACE["dp_du"]), mi.Vector3f(SURFACE["dp_dv"])
    si.n = mi.Normal3f(dr.normalize(dr.cross(si.dp_du, si.dp_dv)))
    n = dr.normalize(mi.Normal3f(SURFACE["n"]))
    s = dr.normalize(si.dp_du - n * dr.dot(n, si.dp_du))
    si.sh_frame = mi.Frame3f(s, dr.cross(n, s), n)
    si.wi = dr.normalize(mi.Vector3f(wo))
    return si


def bsdf_rows(plugin: object, rng: np.random.Generator) -> list[str]:
    """Half of the directions are sampled, half uniform."""
    context, rows = mi.BSDFContext(), []
    while len(rows) < ROWS:
        wo, wi = rng.normal(size=(2, 3))
        wo = np.round(wo / np.linalg.norm(wo), 6)
        uv = np.round(rng.random(2), 6)
        if rng.random() < 0.7:
            wo[2] = abs(wo[2])
        si = surface(wo, uv)
        if len(rows) < ROWS // 2:
            sample, _ = plugin.sample(context, si, rng.random(), mi.Point2f(*rng.random(2)))
            wi = np.array(sample.wo)
            if sample.pdf == 0 or mi.has_flag(sample.sampled_type, mi.BSDFFlags.Delta):
                wi = rng.normal(size=3)
        wi = np.round(wi / np.linalg.norm(wi), 6)
        direction = dr.normalize(mi.Vector3f(wi))
        value, pdf = plugin.eval(context, si, direction), plugin.pdf(context, si, direction)
        if pdf > 0 or rng.random() < 0.1:
            rows.append(numbers(wo, wi, uv, value, pdf))
    return rows


def delta_rows(plugin: object, rng: np.random.Generator) -> list[str]:
    """Delta lobes only."""
    rows = []
    while len(rows) < ROWS // 2:
        wo, lobe = rng.normal(size=3), round(rng.random(), 6)
        wo = np.round(wo / np.linalg.norm(wo), 6)
        sample, weight = plugin.sample(mi.BSDFContext(), surface(wo, (0, 0)), lobe, mi.Point2f(0.3, 0.6))
        if sample.pdf > 0 and mi.has_flag(sample.sampled_type, mi.BSDFFlags.Delta | mi.BSDFFlags.Null):
            rows.append(numbers(wo, lobe, sample.wo, weight, sample.pdf, sample.eta))
    return rows


def texture_rows(plugin: object, rng: np.random.Generator) -> list[str]:
    """Texture coordinates in and around the unit square."""
    rows = []
    for _ in range(ROWS):
        uv = np.round(rng.uniform(-2, 3, size=2), 6)
        si = surface((0, 0, 1), uv)
        try:
            gradient = plugin.eval_1_grad(si)
        except RuntimeError:
            gradient = (0, 0)
        color = plugin.eval(si)
        # Mitsuba 3.9.1 exchanges the two colors of a checkerboard when asked for one number; ours does not.
        number = np.mean(color) if "Checkerboard" in str(plugin) else plugin.eval_1(si)
        rows.append(numbers(uv, color, number, gradient))
    return rows


def main() -> None:
    """Write the file."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    make_images()
    lines = [f"# Made by data/make_bsdf_reference.py with Mitsuba {mi.__version__} ({mi.variant()})"]
    families = (("bsdf", BSDFS, bsdf_rows), ("delta", DELTAS, delta_rows), ("texture", TEXTURES, texture_rows))
    for family, members, make in families:
        for index, (name, xml) in enumerate(members.items()):
            lines.append(f"{family},{name},{xml}")
            lines += make(load(xml), np.random.default_rng([index, ROWS]))
    (FOLDER / "bsdf_reference.csv").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
