// SPDX-License-Identifier: MIT
#include "core/scene/framing.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/scene/depth_sketch.h"
#include "core/scene/rig.h"

namespace grisaille::scene {
namespace {

constexpr double kFovyDegrees = 40, kInsideFovyDegrees = 60;
constexpr double kMargin = 0.04;      // free border, as a share of half the picture
constexpr size_t kMostFaces = 20000;  // that a view is judged by
constexpr double kSketchPixels = 96 * 54;

// Views from outside: rings of directions, from the front and a little from the right at best.
struct DirectionRing {
  double elevation;  // degrees
  double weight;
};
constexpr DirectionRing kRings[] = {{12, 1}, {24, 1}, {36, 0.9}, {50, 0.7}};
constexpr int kAzimuthStep = 30;  // degrees
constexpr double kFront = 30;     // degrees
constexpr double kFrontWeight = 0.15;

// A scene is an interior if a view from within its bounds shows hardly any sky, this many faces,
// and no fewer than the best view from outside. The eye stands in the room, not behind a wall whose
// back is not drawn.
constexpr double kInteriorCovered = 0.97, kInteriorFaces = 100, kInteriorThrough = 0.02;
constexpr double kSampleThrough = 0.5;  // a sample lacks fronts, so that backs show
constexpr size_t kMostInside = 4;       // views that the whole scene is drawn for
constexpr double kInteriorNear = 0.1;   // as a share of half the diagonal of the bounds

constexpr int kFramedTimes = 17;  // of an animation

// Half the picture's width and height at 1 m view depth, without the border.
glm::dvec2 slopeOf(double aspect) {
  const double y = std::tan(glm::radians(kFovyDegrees) / 2) * (1 - kMargin);
  return {y * aspect, y};
}

// The extent of points as a pyramid of fixed direction and slopes sees it.
class Extent {
 public:
  // `backward`: unit, from the scene to the eye. Points are relative to an origin.
  Extent(const glm::dvec3& backward, const glm::dvec2& slope)
      : axes_(worldFromView({.eye = backward, .target = glm::dvec3(0)})), slope_(slope) {}

  void add(const Face& face) {
    for (const glm::dvec3& corner : face.corners) add(corner);
  }

  void add(const glm::dvec3& point) {
    const glm::dvec3 p = glm::transpose(axes_) * point;
    // The pyramid with its tip at e holds p if p.x - e.x <= (e.z - p.z) * slope.x, and so on.
    low_ = glm::max(low_, glm::dvec2(-p) + p.z * slope_);
    high_ = glm::max(high_, glm::dvec2(p) + p.z * slope_);
    nearest_ = std::max(nearest_, p.z);
    farthest_ = std::min(farthest_, p.z);
  }

  // The camera, relative to the origin, whose picture holds all points and is filled by them from
  // side to side or from top to bottom. `least`: smallest size of a scene, metres.
  Camera camera(double least) const {
    const glm::dvec2 middle = (high_ - low_) / 2.0;
    const glm::dvec2 height = (high_ + low_) / (2.0 * slope_);
    const double size = std::max({nearest_ - farthest_, 2 * (height.x - nearest_) * slope_.x,
                                  2 * (height.y - nearest_) * slope_.y, least});
    const double eye = std::max({height.x, height.y, nearest_ + size / 16});
    Camera camera;
    camera.eye = axes_ * glm::dvec3(middle, eye);
    camera.target = axes_ * glm::dvec3(middle, (nearest_ + farthest_) / 2);
    camera.fovyDegrees = kFovyDegrees;
    camera.nearPlane = std::min(eye - nearest_, (eye - farthest_) / 50) / 2;
    return camera;
  }

 private:
  glm::dmat3 axes_;
  glm::dvec2 slope_;
  glm::dvec2 low_ = glm::dvec2(std::numeric_limits<double>::lowest());
  glm::dvec2 high_ = glm::dvec2(std::numeric_limits<double>::lowest());
  double nearest_ = std::numeric_limits<double>::lowest();
  double farthest_ = std::numeric_limits<double>::max();
};

double areaOf(const Face& face) {
  return glm::length(
      glm::cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]));
}

// At most 2 * kMostFaces faces, spread evenly over the surface: every face of more than the mean
// area of a sample, and of smaller ones as many as their area deserves.
std::vector<Face> samplesOf(const Scene& scene, const glm::dvec3& origin) {
  const bool all = triangleCount(scene) <= kMostFaces;
  double area = 0;
  if (!all) forEachFace(scene, origin, [&](const Face& face) { area += areaOf(face); });
  std::vector<Face> samples;
  double passed = 0;
  forEachFace(scene, origin, [&](const Face& face) {
    const double before = std::floor(passed);
    passed += all ? 1 : areaOf(face) / area * kMostFaces;
    if (std::floor(passed) > before) samples.push_back(face);
  });
  return samples;
}

glm::dvec3 directionOf(double azimuth, double elevation) {
  const double a = glm::radians(azimuth), e = glm::radians(elevation);
  return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

// Adds all points that the picture must hold. `origin`: that the points are relative to.
using AddAll = std::function<void(const glm::dvec3& origin, Extent& extent)>;

// A sample of the scene's faces, relative to the centre of its bounds, and the picture's shape.
class Views {
 public:
  Views(const Scene& scene, double aspect, AddAll addAll)
      : scene_(scene),
        aspect_(aspect),
        addAll_(std::move(addAll)),
        origin_((scene.bounds.min + scene.bounds.max) / 2.0),
        samples_(samplesOf(scene, origin_)) {}

  Camera best() const {
    const View outside = bestOutside();
    const View inside = bestInside(outside);
    Camera camera = inside.score > 0 ? inside.camera : framed(outside.direction);
    camera.eye += origin_;
    camera.target += origin_;
    return camera;
  }

 private:
  struct View {
    Camera camera = {};
    glm::dvec3 direction = glm::dvec3(0, 0, 1);  // from the scene to the eye
    double score = -1, covered = 0, faces = 0, through = 0;

    bool isInterior(double mostThrough) const {
      return covered >= kInteriorCovered && through <= mostThrough;
    }
  };

  // Judges a view by the share of the picture that the scene covers, and by the number of faces.
  // Surfaces nearer than `least` only hide others.
  template <typename DrawAll>
  View judged(const Camera& camera, double weight, double least, DrawAll&& drawAll) const {
    const auto side = [](double pixels) {
      return static_cast<uint32_t>(std::clamp(pixels, 1.0, kSketchPixels));
    };
    DepthSketch sketch(camera, side(std::sqrt(kSketchPixels * aspect_)),
                       side(std::sqrt(kSketchPixels / aspect_)));
    drawAll(sketch);
    View view{.camera = camera};
    view.covered = sketch.covered();
    view.through = sketch.throughBacks();
    view.faces = static_cast<double>(sketch.visibleFaces());
    view.score = weight * sketch.covered(least) * std::pow(view.faces, 0.3);
    return view;
  }
  View judged(const Camera& camera, double weight, double least = 0) const {
    return judged(camera, weight, least, [&](DepthSketch& sketch) {
      for (const Face& face : samples_) sketch.draw(face);
    });
  }

  View bestOutside() const {
    View best;
    if (samples_.empty()) return best;
    for (const DirectionRing& ring : kRings) {
      for (int azimuth = -180; azimuth < 180; azimuth += kAzimuthStep) {
        const double front = 1 + kFrontWeight * std::cos(glm::radians(azimuth - kFront));
        const glm::dvec3 direction = directionOf(azimuth, ring.elevation);
        Extent extent(direction, slopeOf(aspect_));
        for (const Face& face : samples_) extent.add(face);
        View view = judged(extent.camera(least()), ring.weight * front);
        view.direction = direction;
        if (view.score > best.score) best = view;
      }
    }
    return best;
  }

  // Views from within the bounds across the scene that show an interior, the best first.
  std::vector<View> viewsInside(const View& outside) const {
    std::vector<View> views;
    const glm::dvec3 half = (scene_.bounds.max - scene_.bounds.min) / 2.0;
    const double size = glm::length(half);
    const double shown = std::max(kInteriorFaces, outside.faces);
    const bool flat = !(std::min({half.x, half.y, half.z}) > 0.05 * size);
    if (flat || shown > static_cast<double>(samples_.size())) return views;
    constexpr int kPlaces[][2] = {{-1, -1}, {-1, 0}, {-1, 1}, {0, -1},
                                  {0, 1},   {1, -1}, {1, 0},  {1, 1}};
    const auto consider = [&](const glm::dvec3& place) {
      Camera camera;
      camera.eye = half * place;
      camera.target = glm::dvec3(0, camera.eye.y - 0.05 * half.y, 0);
      camera.fovyDegrees = kInsideFovyDegrees;
      camera.nearPlane = 1e-3 * size;
      const View view = judged(camera, 1, kInteriorNear * size);
      if (view.isInterior(kSampleThrough) && view.faces >= shown) views.push_back(view);
    };
    for (const double height : {-0.4, 0.1}) {
      for (const double out : {0.75, 0.5, 0.3}) {
        for (const auto& [x, z] : kPlaces) consider({out * x, height, out * z});
      }
    }
    std::ranges::stable_sort(views, std::greater(), &View::score);
    return views;
  }

  // The best view from within; a score below 0: the scene is no interior. The sample has holes in
  // near surfaces, so that the whole scene decides between the best views.
  View bestInside(const View& outside) const {
    std::vector<View> views = viewsInside(outside);
    if (views.size() > kMostInside) views.resize(kMostInside);
    View best;
    for (const View& view : views) {
      const double near = kInteriorNear * glm::length(scene_.bounds.max - scene_.bounds.min) / 2;
      const View whole = judged(view.camera, 1, near, [&](DepthSketch& sketch) {
        forEachFace(scene_, origin_, [&](const Face& face) { sketch.draw(face); });
      });
      if (whole.isInterior(kInteriorThrough) && whole.score > best.score) best = whole;
    }
    return best;
  }

  // The view from outside that holds every vertex, not only those of the sample.
  Camera framed(const glm::dvec3& direction) const {
    Extent extent(direction, slopeOf(aspect_));
    if (samples_.empty()) extent.add(glm::dvec3(0));
    addAll_(origin_, extent);
    return extent.camera(least());
  }

  // The smallest size of a scene that doubles resolve at this place, metres.
  double least() const { return 1e-9 + 1e-10 * glm::length(origin_); }

  const Scene& scene_;
  double aspect_;
  AddAll addAll_;
  glm::dvec3 origin_;
  std::vector<Face> samples_;
};

}  // namespace

Camera framingCamera(const Scene& scene, double aspect) {
  const auto addAll = [&](const glm::dvec3& origin, Extent& extent) {
    forEachFace(scene, origin, [&](const Face& face) { extent.add(face); });
  };
  return Views(scene, aspect, addAll).best();
}

Camera framingCamera(Scene& scene, size_t animation, double aspect) {
  pose(scene, {.animation = animation, .seconds = 0});
  const double duration = scene.rig->animations[animation].duration;
  const auto addAll = [&](const glm::dvec3& origin, Extent& extent) {
    for (int i = 0; i < kFramedTimes; ++i) {
      const double seconds = duration * i / (kFramedTimes - 1);
      pose(scene, {.animation = animation, .seconds = seconds});
      forEachFace(scene, origin, [&](const Face& face) { extent.add(face); });
    }
  };
  const Camera camera = Views(scene, aspect, addAll).best();
  pose(scene, {});
  return camera;
}

}  // namespace grisaille::scene
