// SPDX-License-Identifier: MIT
#include "app/apply/normal_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "app/apply/facets.h"
#include "core/base/error.h"

namespace grisaille::app {
namespace {

struct Sample {
  glm::dvec3 stored = glm::dvec3(0);  // as in the file, decoded
  glm::dvec3 facet = glm::dvec3(0);   // view space; 0: the depth shows no clear facet
  glm::dvec3 sight = glm::dvec3(0);   // view space
};

template <typename... Args>
[[noreturn]] void refuse(const std::string& file, fmt::format_string<Args...> why, Args&&... args) {
  throw Error(ErrorId::kPictureNormal, "{}: {}", file,
              fmt::format(why, std::forward<Args>(args)...));
}

template <typename Holds>
double shareOf(const std::vector<Sample>& samples, const Holds& holds) {
  const auto count = std::ranges::count_if(samples, holds);
  return static_cast<double>(count) / static_cast<double>(std::max(samples.size(), size_t{1}));
}

glm::dvec3 decode(const glm::dvec3& stored) {
  return 2.0 * stored - 1.0;
}

bool isUnit(const glm::dvec3& v) {
  return std::abs(glm::length(v) - 1) < 0.05;
}

// Surface pixels, spread evenly over the picture.
std::vector<Sample> samplesOf(const image::Image& normals, const Surfaces& surfaces) {
  constexpr double kMost = 20000;
  const image::Image& depth = surfaces.viewDepth;
  const double pixels = static_cast<double>(depth.width) * depth.height;
  const auto step = static_cast<uint32_t>(std::ceil(std::sqrt(std::max(1.0, pixels / kMost))));
  const Facets facets(surfaces);
  std::vector<Sample> samples;
  for (uint32_t y = step / 2; y < depth.height; y += step) {
    for (uint32_t x = step / 2; x < depth.width; x += step) {
      if (!(depth.at(x, y) > 0)) continue;
      samples.push_back(
          {.stored = glm::dvec3(normals.at(x, y, 0), normals.at(x, y, 1), normals.at(x, y, 2)),
           .facet = facets.normal(x, y).value_or(glm::dvec3(0)),
           .sight = facets.sight(x, y)});
    }
  }
  return samples;
}

void checkZero(const std::vector<Sample>& samples, const std::string& file, Warnings& warnings) {
  const double zero = shareOf(samples, [](const Sample& s) { return s.stored == glm::dvec3(0); });
  if (zero >= 0.5) {
    refuse(file, "{:.0f} % of the surface pixels have a normal of length 0", 100 * zero);
  }
  if (zero < 0.01) return;
  warnings.once("zero", fmt::format("{}: {:.1f} % of the surface pixels have a normal of length 0",
                                    file, 100 * zero));
}

// Decodes the samples if the form says so.
void checkEncoding(std::vector<Sample>& samples, const NormalForm& form, const std::string& file) {
  const double positive = shareOf(samples, [](const Sample& s) {
    return std::min({s.stored.x, s.stored.y, s.stored.z}) > -0.001;
  });
  const double decoded = shareOf(samples, [](const Sample& s) { return isUnit(decode(s.stored)); });
  const double plain = shareOf(samples, [](const Sample& s) { return isUnit(s.stored); });
  if (!form.unsignedCodes) {
    if (positive < 0.999 || decoded < 0.8 || plain > decoded) return;
    refuse(file,
           "the normals look encoded from 0 to 1: no component is negative, and 2 n - 1 has length "
           "1 at {:.0f} % of the surface pixels, n at {:.0f} %; pass --normal-encoding unsigned",
           100 * decoded, 100 * plain);
  }
  if (positive < 0.99) {
    refuse(file,
           "{:.0f} % of the surface pixels have a normal with a negative component, which "
           "--normal-encoding unsigned has none of; leave the option out",
           100 * (1 - positive));
  }
  for (Sample& s : samples) s.stored = decode(s.stored);
}

void checkLengths(const std::vector<Sample>& samples, const std::string& file, Warnings& warnings) {
  std::vector<double> lengths;
  double sum = 0;
  for (const Sample& s : samples) {
    if (s.stored == glm::dvec3(0)) continue;
    lengths.push_back(glm::length(s.stored));
    sum += lengths.back();
  }
  if (lengths.empty()) return;
  std::ranges::sort(lengths);
  const auto quantile = [&](double part) {
    return lengths[static_cast<size_t>(part * static_cast<double>(lengths.size() - 1))];
  };
  const double median = quantile(0.5);
  const auto alike = std::ranges::count_if(
      lengths, [&](double length) { return std::abs(length - median) < 0.1 * median; });
  if (alike * 2 < std::ssize(lengths)) {
    refuse(file,
           "the lengths vary from {:.3g} to {:.3g} (90 % of the surface pixels), but normals have "
           "length 1",
           quantile(0.05), quantile(0.95));
  }
  if (std::abs(median - 1) < 0.02) return;
  warnings.once("length",
                fmt::format("{}: the normals have a mean length of {:.3g}, not 1; they are scaled",
                            file, sum / static_cast<double>(lengths.size())));
}

// A way to read the stored numbers: a space, and an axis with a sign for each component.
struct Reading {
  bool view = false;
  std::array<int, 3> axes = {0, 1, 2};
  std::array<int, 3> signs = {1, 1, 1};

  bool plain() const { return axes == std::array{0, 1, 2} && signs == std::array{1, 1, 1}; }
  // A unit normal in view space.
  glm::dvec3 operator()(const glm::dvec3& stored, const glm::dmat3& viewFromWorld) const {
    glm::dvec3 n;
    for (int c = 0; c < 3; ++c) {
      n[c] = signs[static_cast<size_t>(c)] * stored[axes[static_cast<size_t>(c)]];
    }
    n /= glm::length(n);
    return view ? n : viewFromWorld * n;
  }
  // "as view-space normals (x, -z, y)"
  std::string text(const NormalForm& form) const {
    std::string space = view == form.view ? "" : view ? "view" : "world";
    if (!space.empty()) {
      space = fmt::format(" as {0}-space normals, --normal-space {0}", space);
    }
    if (plain()) return space;
    std::string names;
    for (size_t c = 0; c < 3; ++c) {
      names += fmt::format("{}{}{}", c > 0 ? ", " : "", signs[c] < 0 ? "-" : "", "xyz"[axes[c]]);
    }
    return fmt::format("{}{} written as ({})", space, space.empty() ? "" : ",", names);
  }
};

// All readings, those that differ least from the form first.
std::vector<Reading> readingsOf(const NormalForm& form) {
  std::vector<Reading> all;
  for (const bool view : {form.view, !form.view}) {
    std::array<int, 3> axes = {0, 1, 2};
    do {
      for (int bits = 0; bits < 8; ++bits) {
        const auto sign = [&](int c) { return (bits >> c & 1) != 0 ? -1 : 1; };
        all.push_back({view, axes, {sign(0), sign(1), sign(2)}});
      }
    } while (std::ranges::next_permutation(axes).found);
  }
  std::ranges::stable_sort(all, std::ranges::greater(), [](const Reading& r) { return r.plain(); });
  return all;
}

// How well a reading's normals fit the facets.
struct Fit {
  double share = 0;    // of the normals, within kClose of the facet
  double degrees = 0;  // mean
  size_t samples = 0;
};

Fit fitOf(const Reading& reading, const std::vector<Sample>& samples, const glm::dmat3& turn) {
  constexpr double kClose = 10;  // degrees
  Fit fit;
  for (const Sample& s : samples) {
    if (s.facet == glm::dvec3(0) || s.stored == glm::dvec3(0)) continue;
    const double cosine = glm::dot(reading(s.stored, turn), s.facet);
    const double degrees = glm::degrees(std::acos(std::clamp(cosine, -1.0, 1.0)));
    fit.share += degrees < kClose ? 1 : 0;
    fit.degrees += degrees;
    ++fit.samples;
  }
  const auto count = static_cast<double>(std::max(fit.samples, size_t{1}));
  fit.share /= count;
  fit.degrees /= count;
  return fit;
}

// Refuses normals that face away, and those that another reading fits to the facets far better.
// Warns where the reading is better by less.
void checkDirections(const std::vector<Sample>& samples, const NormalForm& form,
                     const scene::Camera& camera, const std::string& file, Warnings& warnings) {
  constexpr double kGood = 0.6, kBetter = 0.25, kDoubtful = 0.08, kSame = 0.02;  // shares
  constexpr double kBad = 60;                                                    // degrees
  const glm::dmat3 turn = glm::transpose(scene::worldFromView(camera));
  const Reading given{.view = form.view};
  const double away = shareOf(samples, [&](const Sample& s) {
    return s.stored != glm::dvec3(0) && glm::dot(given(s.stored, turn), s.sight) > 0;
  });
  const Fit own = fitOf(given, samples, turn);
  const bool clear = own.samples >= 100 && own.samples * 20 >= samples.size();
  Reading best = given;
  Fit other = own;
  for (const Reading& reading : readingsOf(form)) {
    const Fit fit = fitOf(reading, samples, turn);
    if (fit.share <= other.share + kSame) continue;
    best = reading;
    other = fit;
  }
  const double gain = clear && other.share >= kGood ? other.share - own.share : 0;
  const std::string advice =
      gain < kDoubtful
          ? ""
          : fmt::format("; they fit the depth to {:.0f} degrees{}", other.degrees, best.text(form));
  if (away > 0.5) {
    refuse(file, "{:.0f} % of the surface pixels have a normal that faces away from the camera{}",
           100 * away, advice);
  }
  const std::string off = fmt::format(
      "the normals are off the facets of the depth by a mean of {:.0f} degrees", own.degrees);
  if (gain >= kBetter) refuse(file, "{}{}", off, advice);
  if (gain >= kDoubtful) {
    warnings.once("directions", fmt::format("{}: {}{}", file, off, advice));
  } else if (clear && own.degrees > kBad) {
    warnings.once("directions",
                  fmt::format("{}: {}; check that depth, normals and camera are of the same frame",
                              file, off));
  }
}

}  // namespace

void takeNormals(image::Image& normals, const NormalForm& form, const Surfaces& surfaces,
                 const std::string& file, Warnings& warnings) {
  std::vector<Sample> samples = samplesOf(normals, surfaces);
  if (!samples.empty()) {
    checkZero(samples, file, warnings);
    checkEncoding(samples, form, file);
    checkLengths(samples, file, warnings);
    checkDirections(samples, form, surfaces.camera, file, warnings);
  }
  const glm::dmat3 turn = form.view ? scene::worldFromView(surfaces.camera) : glm::dmat3(1);
  if (!form.view && !form.unsignedCodes) return;
  for (size_t i = 0; i < normals.pixels.size(); i += 3) {
    const glm::dvec3 stored(normals.pixels[i], normals.pixels[i + 1], normals.pixels[i + 2]);
    const glm::vec3 world(turn * (form.unsignedCodes ? decode(stored) : stored));
    for (int c = 0; c < 3; ++c) normals.pixels[i + static_cast<size_t>(c)] = world[c];
  }
}

}  // namespace grisaille::app
