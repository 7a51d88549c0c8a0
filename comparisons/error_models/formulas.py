"""The formulas that a renderer may declare, each with a line of code by which people recognise their own."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Formula:
    """One value of a field of ErrorModel."""

    field: str
    value: str
    code: str
    """As in C and its kin: o and d are a ray's origin and direction, p a point on it, n a normal, C and r a sphere's
    centre and radius; a, b, c are a triangle's corners or a quadratic's coefficients, e1 and e2 the edges b-a and c-a;
    n1, n2 are indices of refraction and c1, c2 cosines before and behind a surface."""


FORMULAS = (
    Formula("sphere_test", "quadratic", "t = (-b - sqrt(b*b - 4*a*c)) / (2*a), c = dot(o-C, o-C) - r*r"),
    Formula("sphere_test", "stable quadratic", "q = -0.5*(b + sign(b)*sqrt(b*b - 4*a*c)); t = q/a or c/q"),
    Formula("sphere_test", "geometric", "tca = dot(C-o, d); d2 = dot(C-o, C-o) - tca*tca; t = tca - sqrt(r*r - d2)"),
    Formula("sphere_test", "accurate", "h = o-C - dot(o-C, d)*d; disc = r*r - dot(h, h)"),
    Formula("triangle_test", "moeller-trumbore of 1997", "p = cross(d, e2); u = dot(o-a, p)/dot(e1, p)"),
    Formula("triangle_test", "cramer", "u = det(a-o, a-c, d)/det(a-b, a-c, d), v and t likewise"),
    Formula("triangle_test", "plane and inside", "t = (dot(n, a) - dot(n, o))/dot(n, d); dot(n, cross(b-a, p-a)) >= 0"),
    Formula("triangle_test", "watertight", "u = cx*by - cy*bx, of corners sheared along the ray's longest axis"),
    Formula("triangle_test", "pluecker", "u = dot(cross(c-a, c+a - 2*o), d), as Embree's robust mode"),
    Formula("triangle_test", "moeller-trumbore", "n = cross(e2, e1); u = dot(cross(a-o, d), e2)/dot(n, d), as Embree"),
    Formula("triangle_points", "along the ray", "p = o + t*d"),
    Formula("triangle_points", "barycentric", "p = (1-u-v)*a + u*b + v*c"),
    Formula("sphere_points", "along the ray", "n = (p - C)/r"),
    Formula("sphere_points", "normalised", "n = normalize(p - C)"),
    Formula("fresnel", "cosines", "rs = (n1*c1 - n2*c2)/(n1*c1 + n2*c2), rp = (n2*c1 - n1*c2)/(n2*c1 + n1*c2)"),
    Formula("fresnel", "as specified", "rs = (c1 - g)/(c1 + g), rp = (eta*eta*c1 - g)/(eta*eta*c1 + g), eta = n2/n1"),
    Formula("fresnel", "accurate", "rs = (eta - 1)*(eta + 1)/((g+c1)*(g+c1)); q = (c1*g - s2)/(c1*g + s2), rp = q*rs"),
    Formula("refraction", "heckbert", "c2 = sqrt(1 - e*e*(1 - c1*c1)); t = e*d + (e*c1 - c2)*n, e = n1/n2"),
    Formula("refraction", "bec", "w = e*c1; t = e*d + (w - sqrt(1 + (w-e)*(w+e)))*n, e = n1/n2"),
    Formula("refraction", "as specified", "g = sqrt(eta*eta - 1 + c1*c1); t = (d + (c1 - g)*n)/eta, eta = n2/n1"),
    Formula("refraction", "accurate", "the same, with g = sqrt((eta - 1)*(eta + 1) + c1*c1)"),
    Formula(
        "directions", "normalised", "r = normalize(reflect(d, n)); l = normalize(light - p), hit if t < |light - p|"
    ),
    Formula("directions", "unnormalised", "r = reflect(d, n); l = light - p, hit if eps < t < 1"),
    Formula("directions", "as in the truth", "the same, with least distances divided by the direction's length"),
)
"""Those of each field together; of each the one that students have most often first."""


def in_code(field: str, value: str) -> str:
    """What a field says, with its line of code if there is one; a clause without an end."""
    code = next((formula.code for formula in FORMULAS if (formula.field, formula.value) == (field, value)), "")
    return f"{value}: {code}" if code else value
