"""The tracer's scenes for Mitsuba 3: geometry, materials, lights and camera of examples/tracer/scene_*.hpp.

A scene is a function that gives a dictionary for mitsuba.load_dict, for the variant that is set. Integrator, film and
sampler are left to the caller.
"""

from pathlib import Path

import drjit
import mitsuba
import numpy

MAP = Path(__file__).resolve().parent.parent / "examples/data/venice_sunset_1k.hdr"


def camera(position, target, field_of_view):
    return {"type": "perspective", "fov": field_of_view, "fov_axis": "smaller",
            "to_world": mitsuba.ScalarTransform4f().look_at(position, target, [0, 1, 0])}


def diffuse(*albedo):
    return {"type": "diffuse", "reflectance": {"type": "rgb", "value": list(albedo)}}


def parallelogram(corner, u, v, bsdf):
    """Faces u x v. Two triangles: they cost Mitsuba 5 % less than its rectangle, which Embree asks back for."""
    corner, u, v = (numpy.array(vector, dtype=numpy.float32) for vector in (corner, u, v))
    properties = mitsuba.Properties()
    properties["bsdf"] = mitsuba.load_dict(bsdf, parallel=False)
    mesh = mitsuba.Mesh("parallelogram", vertex_count=4, face_count=2, props=properties)
    arrays = mitsuba.traverse(mesh)
    arrays["vertex_positions"] = numpy.concatenate([corner, corner + u, corner + u + v, corner + v])
    arrays["faces"] = numpy.array([0, 1, 2, 0, 2, 3], dtype=numpy.uint32)
    arrays.update()
    return mesh


def sphere(center, radius, **what):
    return {"type": "sphere", "center": list(center), "radius": radius, **what}


def veach_metal():
    """Plates of GGX that reflect everything under five lights; floor and wall are diffuse."""
    walls = diffuse(0.4, 0.4, 0.4)
    plates = [((-2.70651, 0.25609), (-2.08375, -0.526323), 0.005),
              ((-3.28825, 1.36972), (-2.83856, 0.476536), 0.02),
              ((-3.73096, 2.70046), (-3.43378, 1.74564), 0.05),
              ((-3.99615, 4.0667), (-3.82069, 3.08221), 0.1)]
    lights = [((10, 10, 4), 0.5, 800), ((-3.75, 0, 0), 0.03333, 901.803), ((-1.25, 0, 0), 0.1, 100),
              ((1.25, 0, 0), 0.3, 11.1111), ((3.75, 0, 0), 0.9, 1.23457)]
    scene = {"camera": camera([0, 2, 15], [0, -2, 2.5], 28),
             "floor": parallelogram((-10, -4.14615, -10), (0, 0, 20), (20, 0, 0), walls),
             "wall": parallelogram((-10, -10, -2), (20, 0, 0), (0, 20, 0), walls)}
    for i, ((y, z), (back_y, back_z), alpha) in enumerate(plates):
        # Light from the floor reaches plates from below as well.
        metal = {"type": "twosided", "bsdf": {"type": "roughconductor", "material": "none", "distribution": "ggx",
                                              "alpha": alpha, "sample_visible": True}}
        scene[f"plate {i}"] = parallelogram((-4, y, z), (8, 0, 0), (0, back_y - y, back_z - z), metal)
    for i, (center, radius, radiance) in enumerate(lights):
        scene[f"light {i}"] = sphere(center, radius, bsdf=diffuse(0, 0, 0),
                                     emitter={"type": "area", "radiance": {"type": "rgb", "value": radiance}})
    return scene


def sky():
    """A mirror and four rough spheres of silver and one of chalk, on a diffuse floor under the sunset.

    The map is sampled where it is brighter than its mean: that takes a quarter off Mitsuba's product of time and error.
    """
    silver = {"eta": {"type": "rgb", "value": [0.1553, 0.1167, 0.1383]},
              "k": {"type": "rgb", "value": [4.8283, 3.1222, 2.1470]}}
    rough = [{"type": "roughconductor", "distribution": "ggx", "alpha": alpha, "sample_visible": True, **silver}
             for alpha in (0.01, 0.05, 0.15, 0.4)]
    materials = [{"type": "conductor", **silver}, *rough, diffuse(0.8, 0.35, 0.2)]
    scene = {"camera": camera([0, 3.2, 16], [0, 1, 0], 24),
             "floor": parallelogram((-30, 0, -30), (0, 0, 60), (60, 0, 0), diffuse(0.5, 0.5, 0.5)),
             "sky": {"type": "envmap", "bitmap": mitsuba.Bitmap(str(MAP)), "mis_compensation": True,
                     "to_world": mitsuba.ScalarTransform4f().rotate([0, 1, 0], 90)}}
    for i, material in enumerate(materials):
        scene[f"sphere {i}"] = sphere((2.2 * (i - 2.5), 1, 0), 1, bsdf=material)
    return scene


def with_our_rows(sky):
    """The map in Mitsuba's bilinear lookup as the tracer sees it.

    Mitsuba puts H rows of texels at j / (H - 1) from pole to pole, the tracer at (j + 1/2) / H. With 2 H + 1 rows, every
    other one the mean of its neighbours, both are one function.
    """
    rows = numpy.array(sky["bitmap"], dtype=numpy.float32)[..., :3]
    doubled = numpy.empty((2 * len(rows) + 1, *rows.shape[1:]), dtype=numpy.float32)
    doubled[0::2] = numpy.concatenate([rows[:1], (rows[:-1] + rows[1:]) / 2, rows[-1:]])
    doubled[1::2] = rows
    return {**sky, "bitmap": mitsuba.Bitmap(doubled)}


def with_our_shadowing(metal):
    """A rough conductor whose shadowing and masking are correlated by height, as the tracer's are.

    Mitsuba multiplies G1(wi) G1(wo), with G1 = 1 / (1 + L); the tracer has 1 / (1 + L(wi) + L(wo)) (Heitz 2014, eq. 99).
    A surface of roughness 0.4 is 1 % darker in Mitsuba.
    """
    class Correlated(mitsuba.BSDF):
        def __init__(self):
            super().__init__(mitsuba.Properties())
            self.base = mitsuba.load_dict(metal, parallel=False)
            self.m_components, self.m_flags = [self.base.flags(0)], self.base.flags()

        def ratio(self, wi, wo):
            lambdas = [(drjit.sqrt(1 + metal["alpha"] ** 2 * mitsuba.Frame3f.tan_theta_2(w)) - 1) / 2 for w in (wi, wo)]
            above = (mitsuba.Frame3f.cos_theta(wi) > 0) & (mitsuba.Frame3f.cos_theta(wo) > 0)
            return drjit.select(above, (1 + lambdas[0]) * (1 + lambdas[1]) / (1 + lambdas[0] + lambdas[1]), 0)

        def sample(self, context, si, sample1, sample2, active=True):
            sample, weight = self.base.sample(context, si, sample1, sample2, active)
            return sample, weight * self.ratio(si.wi, sample.wo)

        def eval(self, context, si, wo, active=True):
            return self.base.eval(context, si, wo, active) * self.ratio(si.wi, wo)

        def pdf(self, context, si, wo, active=True):
            return self.base.pdf(context, si, wo, active)

        def eval_pdf(self, context, si, wo, active=True):
            return self.eval(context, si, wo, active), self.pdf(context, si, wo, active)

    return Correlated()


def as_the_tracer_has_it(scene):
    """The scene where Mitsuba's models, slightly different ones, are replaced by the tracer's; not for scalar variants."""
    def replaced(part):
        if not isinstance(part, dict):
            return part
        if part.get("type") == "envmap":
            return with_our_rows(part)
        if part.get("bsdf", {}).get("type") == "roughconductor":
            return {**part, "bsdf": with_our_shadowing(part["bsdf"])}
        return part

    return {name: replaced(part) for name, part in scene.items()}


SCENES = {"veach-metal": (veach_metal, 384, 256), "sky": (sky, 384, 192)}  # in pixels
