// A courtyard in the sun. The temperatures of its walls are known. Its floor and a screen are
// insulated. How much heat enters each wall, and how warm do the floor and the screen become?
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <shaftcull/shaftcull.hpp>
#include <vector>

namespace sc = shaftcull;
using Values = std::vector<double>;  // one for each patch

namespace {

constexpr double stefan_boltzmann = 5.670374e-8;  // W/(m² K⁴)
// W/m²: the sun on a surface that faces it; the light and the heat of the open sky.
constexpr double sun = 700, sky_light = 90, sky_heat = 340;
constexpr sc::Vec3 to_sun{-1 / 3.0F, -2 / 3.0F, 2 / 3.0F};  // of unit length; y points north
constexpr double insulated = 0;                             // in place of a temperature

// Columns × rows patches of 1 m² each. As seen from the side that radiates, the turn from the
// unit vector `along` to the unit vector `up` is counterclockwise.
struct Surface {
  const char* name;
  sc::Vec3 corner, along, up;
  int columns, rows;
  double emissivity, albedo, kelvin;
};
constexpr Surface surfaces[]{
    {"north wall", {0, 6, 0}, {1, 0, 0}, {0, 0, 1}, 8, 4, 0.90, 0.5, 303.15},
    {"south wall", {8, 0, 0}, {-1, 0, 0}, {0, 0, 1}, 8, 4, 0.90, 0.5, 298.15},
    {"east wall", {8, 6, 0}, {0, -1, 0}, {0, 0, 1}, 6, 4, 0.90, 0.5, 298.15},
    {"west wall", {0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 6, 4, 0.90, 0.5, 298.15},
    {"floor", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 8, 6, 0.95, 0.3, insulated},
    {"screen, south", {2, 4, 0}, {1, 0, 0}, {0, 0, 1}, 4, 2, 0.90, 0.6, insulated},
    {"screen, north", {6, 4, 0}, {-1, 0, 0}, {0, 0, 1}, 4, 2, 0.90, 0.6, insulated}};

sc::Vec3 point(const Surface& s, int column, int row) {
  const auto u = static_cast<float>(column), v = static_cast<float>(row);
  sc::Vec3 p = s.corner;
  for (std::size_t k = 0; k != 3; ++k) p[k] += u * s.along[k] + v * s.up[k];
  return p;
}

// The cosine of the angle between the sun and the normal, which is along × up.
double cosine_of_sun(const Surface& s) {
  const sc::Vec3 &a = s.along, &u = s.up;
  return to_sun[0] * (a[1] * u[2] - a[2] * u[1]) + to_sun[1] * (a[2] * u[0] - a[0] * u[2]) +
         to_sun[2] * (a[0] * u[1] - a[1] * u[0]);
}

struct Radiation {
  Values arriving, leaving;  // W/m²
  double absorbed(std::size_t i) const { return arriving[i] - leaving[i]; }
};

// A patch emits, and reflects a part of the radiation that arrives from the other patches and
// from the sky. Gauss-Seidel sweeps solve these equations.
Radiation solve(const sc::ViewFactors& factors, const Values& emitted,
                const Values& reflectance, double sky) {
  Radiation r{emitted, emitted};
  for (int sweep = 0; sweep != 100; ++sweep) {
    for (std::size_t i = 0; i != factors.size(); ++i) {
      r.arriving[i] = (1 - factors.sum[i]) * sky;
      for (std::size_t k = factors.first[i]; k != factors.first[i + 1]; ++k)
        r.arriving[i] += factors.factor[k] * r.leaving[factors.column[k]];
      r.leaving[i] = emitted[i] + reflectance[i] * r.arriving[i];
    }
  }
  return r;
}

}  // namespace

int main() {
  std::vector<sc::Vec3> corners;
  std::vector<std::size_t> first_corner{0};
  std::vector<const Surface*> surface;  // of each patch
  for (const Surface& s : surfaces) {
    for (int i = 0; i != s.columns * s.rows; ++i) {
      const int x = i % s.columns, y = i / s.columns;
      for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
        corners.push_back(point(s, x + dx, y + dy));
      first_corner.push_back(corners.size());
      surface.push_back(&s);
    }
  }
  const sc::PatchSet patches(corners, first_corner);
  sc::Occluders occluders;
  occluders.add_polygons(corners, first_corner);  // each patch hides the space behind it
  const sc::ViewFactors factors = sc::view_factors(patches, occluders);
  std::vector<float> lit(patches.size());
  sc::lit_fractions(patches, occluders, std::span(&to_sun, 1), lit, {.rays = 1024});

  // Light: patches reflect the sun and the sky.
  Values direct(lit.begin(), lit.end()), emitted(direct), reflectance(direct);
  for (std::size_t i = 0; i != direct.size(); ++i) {
    direct[i] *= sun * std::max(0.0, cosine_of_sun(*surface[i]));
    reflectance[i] = surface[i]->albedo;
    emitted[i] = reflectance[i] * direct[i];
  }
  const Radiation light = solve(factors, emitted, reflectance, sky_light);

  // Heat: an insulated patch sends out all that it absorbs, so its temperature is not needed.
  for (std::size_t i = 0; i != direct.size(); ++i) {
    const Surface& s = *surface[i];
    const bool known = s.kelvin != insulated;
    reflectance[i] = known ? 1 - s.emissivity : 1;
    emitted[i] = known ? s.emissivity * stefan_boltzmann * std::pow(s.kelvin, 4)
                       : direct[i] + light.absorbed(i);
  }
  const Radiation heat = solve(factors, emitted, reflectance, sky_heat);

  double in = 0, out = 0, walls = 0;  // W
  std::printf("                sun W/m2      C  net heat W/m2\n");
  for (const Surface& s : surfaces) {
    double sunlight = 0, celsius = 0, net = 0;  // sums over patches of 1 m²
    for (std::size_t i = 0; i != direct.size(); ++i) {
      if (surface[i] != &s) continue;
      const double black_body = heat.arriving[i] - heat.absorbed(i) / s.emissivity;
      celsius += std::sqrt(std::sqrt(black_body / stefan_boltzmann)) - 273.15;
      sunlight += direct[i];
      net += direct[i] + light.absorbed(i) + heat.absorbed(i);
      in += direct[i] + (1 - factors.sum[i]) * (sky_light + sky_heat);
      out += (1 - factors.sum[i]) * (light.leaving[i] + heat.leaving[i]);
    }
    walls += net;
    const int n = s.columns * s.rows;
    std::printf("%-13s  %9.0f  %5.1f  %13.0f\n", s.name, sunlight / n, celsius / n,
                std::round(net / n) + 0.0);  // + 0.0 turns -0 into 0
  }
  std::printf("from sun and sky %.2f kW, to the sky %.2f kW, into the walls %.2f kW\n",
              in / 1000, out / 1000, walls / 1000);
  std::printf("balance: %.6f W\n", std::fabs(in - out - walls));
}
