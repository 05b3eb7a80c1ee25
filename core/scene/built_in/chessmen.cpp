// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "core/scene/built_in/carvings.h"

namespace grisaille::scene {
namespace {

constexpr uint32_t kTurned = 26;  // segments of turned pieces

// The foot that all pieces of chess share, up to the radius and height of the neck.
std::vector<glm::dvec2> foot(double radius) {
  const double r = radius;
  return {{0.96 * r, 0},       {r, 0.06 * r},        {r, 0.2 * r},         {0.94 * r, 0.27 * r},
          {0.82 * r, 0.3 * r}, {0.82 * r, 0.38 * r}, {0.86 * r, 0.44 * r}, {0.8 * r, 0.54 * r},
          {0.6 * r, 0.72 * r}, {0.47 * r, 1.0 * r}};
}

Solid turnedPiece(double radius, std::initializer_list<glm::dvec2> above,
                  uint32_t segments = kTurned) {
  std::vector<glm::dvec2> profile = foot(radius);
  for (const glm::dvec2& p : above) profile.push_back(p * radius);
  return lathe(profile, segments);
}

}  // namespace

Solid pawn() {
  return turnedPiece(0.0125, {{0.36, 1.4},
                              {0.33, 1.62},
                              {0.55, 1.68},
                              {0.58, 1.75},
                              {0.5, 1.8},
                              {0.3, 1.84},
                              {0.34, 1.9},
                              {0.5, 2.02},
                              {0.56, 2.22},
                              {0.52, 2.42},
                              {0.38, 2.58},
                              {0.16, 2.66}});
}

Solid rook() {
  Solid solid = turnedPiece(0.014, {{0.45, 1.5},
                                    {0.44, 1.85},
                                    {0.62, 1.92},
                                    {0.64, 2.0},
                                    {0.55, 2.06},
                                    {0.54, 2.14},
                                    {0.72, 2.24},
                                    {0.74, 2.55},
                                    {0.7, 2.58},
                                    {0.5, 2.58},
                                    {0.48, 2.3}});
  // The merlons.
  const double r = 0.014;
  for (int k = 0; k < 6; ++k) {
    std::vector<Ring> rings;
    for (int i = 0; i <= 3; ++i) {
      const double turn = k / 6.0 + 0.11 * (i / 3.0 - 0.5), c = cosTurns(turn), s = sinTurns(turn);
      Ring& ring = rings.emplace_back();
      for (const glm::dvec2& p : {glm::dvec2(0.51, 2.5), glm::dvec2(0.725, 2.5),
                                  glm::dvec2(0.725, 2.84), glm::dvec2(0.51, 2.84)}) {
        ring.emplace_back(r * p.x * c, r * p.y, r * p.x * s);
      }
    }
    append(solid, loft(rings, false));
  }
  return solid;
}

Solid knight() {
  Solid solid = turnedPiece(0.014, {{0.6, 1.12}, {0.62, 1.2}, {0.5, 1.3}, {0.3, 1.34}});
  // Sections of neck and head: centre (along, up), half depth, half width.
  constexpr glm::dvec4 kHead[] = {
      {-0.0006, 0.015, 0.0088, 0.0078}, {-0.002, 0.0205, 0.0088, 0.0072},
      {-0.0028, 0.027, 0.0082, 0.0064}, {-0.0018, 0.033, 0.0078, 0.0058},
      {0.0012, 0.0382, 0.0076, 0.0055}, {0.0055, 0.0405, 0.0072, 0.0055},
      {0.01, 0.0392, 0.006, 0.0048},    {0.0138, 0.0362, 0.0047, 0.0039},
      {0.0168, 0.0335, 0.0042, 0.0038}, {0.0184, 0.0318, 0.003, 0.0028}};
  std::vector<Ring> rings;
  for (size_t i = 0; i < std::size(kHead); ++i) {
    const glm::dvec4 &before = kHead[i > 0 ? i - 1 : 0],
                     &after = kHead[std::min(i + 1, std::size(kHead) - 1)];
    const glm::dvec2 along = glm::normalize(glm::dvec2(after) - glm::dvec2(before));
    Ring& ring = rings.emplace_back();
    for (int k = 0; k < 16; ++k) {
      const double turn = k / 16.0, deep = kHead[i].z * cosTurns(turn),
                   wide = kHead[i].w * sinTurns(turn);
      ring.emplace_back(kHead[i].x - along.y * deep, kHead[i].y + along.x * deep, wide);
    }
  }
  append(solid, loft(rings, false));
  for (const double side : {-1.0, 1.0}) {
    append(solid,
           lathe(std::array{glm::dvec2(0.0022, 0), glm::dvec2(0.0021, 0.003),
                            glm::dvec2(0.0006, 0.0075)},
                 10),
           aimed({0.0012, 0.0445, side * 0.003}, {-0.1, 1, side * 0.25}));
    append(solid, ball(0.0012, 10, 7), moved({0.0085, 0.0418, side * 0.0046}));
    append(solid, ball(0.0007, 8, 6), moved({0.0172, 0.0352, side * 0.0026}));
    append(solid, ball(1, 12, 9),
           moved({0.0048, 0.0356, side * 0.0022}) * scaled({0.005, 0.0055, 0.0036}));
  }
  // Locks of the mane.
  for (int k = 0; k < 9; ++k) {
    const double t = k / 8.0;
    const glm::dvec3 at(-0.0098 - 0.0012 * sinTurns(t / 2) + 0.0085 * t * t, 0.0175 + 0.0265 * t,
                        0);
    append(solid, ball(1, 10, 7),
           moved(at) * turnedZ(-0.1 - 0.1 * t) * scaled({0.0026, 0.0029, 0.0021}));
  }
  return solid;
}

Solid bishop() {
  Solid solid = turnedPiece(0.0135, {{0.37, 1.5},
                                     {0.31, 2.05},
                                     {0.32, 2.3},
                                     {0.56, 2.38},
                                     {0.6, 2.45},
                                     {0.52, 2.51},
                                     {0.34, 2.55},
                                     {0.38, 2.62},
                                     {0.52, 2.78},
                                     {0.54, 2.98},
                                     {0.47, 3.2},
                                     {0.32, 3.42},
                                     {0.17, 3.52},
                                     {0.13, 3.54},
                                     {0.19, 3.62},
                                     {0.2, 3.7},
                                     {0.14, 3.78},
                                     {0.05, 3.81}});
  return solid;
}

Solid queen() {
  Solid solid = turnedPiece(0.0148, {{0.39, 1.5},
                                     {0.3, 2.1},
                                     {0.31, 2.5},
                                     {0.55, 2.58},
                                     {0.6, 2.65},
                                     {0.52, 2.71},
                                     {0.36, 2.74},
                                     {0.36, 2.8},
                                     {0.42, 3.0},
                                     {0.56, 3.34},
                                     {0.6, 3.38},
                                     {0.55, 3.4},
                                     {0.44, 3.32},
                                     {0.3, 3.36},
                                     {0.18, 3.46}});
  const double r = 0.0148;
  for (int k = 0; k < 9; ++k) {
    append(solid, ball(0.1 * r, 8, 6), turned(k / 9.0) * moved({0.53 * r, 3.44 * r, 0}));
  }
  append(solid, ball(0.2 * r, 14, 9), moved({0, 3.55 * r, 0}));
  return solid;
}

Solid king() {
  const double r = 0.0152;
  Solid solid = turnedPiece(r, {{0.41, 1.5},
                                {0.32, 2.15},
                                {0.33, 2.6},
                                {0.57, 2.68},
                                {0.62, 2.76},
                                {0.54, 2.82},
                                {0.38, 2.86},
                                {0.38, 2.92},
                                {0.46, 3.2},
                                {0.56, 3.52},
                                {0.5, 3.58},
                                {0.34, 3.62},
                                {0.2, 3.72},
                                {0.12, 3.76}});
  append(solid,
         block({-0.075 * r, 3.72 * r, -0.06 * r}, {0.075 * r, 4.22 * r, 0.06 * r}, 0.02 * r));
  append(solid,
         block({-0.19 * r, 3.93 * r, -0.055 * r}, {0.19 * r, 4.07 * r, 0.055 * r}, 0.02 * r));
  return solid;
}

}  // namespace grisaille::scene
