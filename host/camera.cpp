// SPDX-License-Identifier: MIT
#include "host/camera.h"

#include <algorithm>
#include <cmath>

#include "host/checks.h"

namespace grisaille::host {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Renderers write more than this for the sky, and less for a scene. Same as in `grisaille apply`.
constexpr double kSky = 1e9;               // metres
constexpr double kFarthestNear = 1e6;      // metres
constexpr double kLargestPosition = 1e15;  // metres
constexpr int kReversedBuffer = 3;         // kBufferReversed of shaders/host/source.glsl

template <typename... Args>
[[noreturn]] void refuse(fmt::format_string<Args...> why, Args&&... args) {
  throw Error(ErrorId::kHostCamera, "{}", fmt::format(why, std::forward<Args>(args)...));
}

glm::dmat4 matrixOf(const double (&numbers)[16], const char* name) {
  glm::dmat4 matrix;
  for (int i = 0; i < 16; ++i) {
    matrix[i / 4][i % 4] = numbers[i];
    if (!std::isfinite(numbers[i])) refuse("{}[{}] is {}", name, i, numbers[i]);
  }
  return matrix;
}

// Sets the position and the axes.
void readView(const grisaille_host_camera& camera, scene::View& seen) {
  const glm::dmat4 view = matrixOf(camera.view, "view");
  const glm::dmat3 turn(view);
  const glm::dmat3 product = glm::transpose(turn) * turn;
  for (int i = 0; i < 9; ++i) {
    if (!(std::abs(product[i / 3][i % 3] - (i % 4 == 0 ? 1 : 0)) <= 1e-3)) {
      refuse("the columns of view are not perpendicular axes of length 1");
    }
  }
  if (glm::determinant(turn) < 0) refuse("view is a reflection");
  if (glm::dvec4(view[0][3], view[1][3], view[2][3], view[3][3]) != glm::dvec4(0, 0, 0, 1)) {
    refuse("the last row of view is not 0, 0, 0, 1");
  }
  seen.worldFromView = glm::transpose(turn);
  seen.eye = -(seen.worldFromView * glm::dvec3(view[3]));
  for (int i = 0; i < 3; ++i) {
    if (!(std::abs(seen.eye[i]) <= kLargestPosition)) {
      refuse("the camera's position holds {}, not within 1e15", seen.eye[i]);
    }
  }
}

// The projection, scaled so that clip w is -z (perspective) or 1 (orthographic), with y up.
struct Projection {
  glm::dmat4 matrix;
  bool orthographic;
};
Projection projectionOf(const grisaille_host_camera& camera) {
  glm::dmat4 matrix = matrixOf(camera.projection, "projection");
  const bool orthographic = matrix[2][3] == 0;
  const double w = orthographic ? matrix[3][3] : -matrix[2][3];
  if (!(w > 0) && orthographic) refuse("the projection's clip w is {}, not over 0", w);
  if (!(w > 0)) refuse("projection[11] is {}, not below 0: view space must look along -z", -w);
  matrix /= w;
  if (matrix[1][1] < 0) {
    for (int column = 0; column < 4; ++column) matrix[column][1] *= -1;
  }
  // The entries that both kinds lack, and those that one kind lacks: column, row.
  constexpr int kBoth[][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 0}, {1, 2}, {1, 3}};
  constexpr int kPerspective[][2] = {{3, 0}, {3, 1}, {3, 3}};
  constexpr int kOrthographic[][2] = {{2, 0}, {2, 1}, {2, 3}};
  const auto expectNone = [&](const int(&entry)[2]) {
    const double value = matrix[entry[0]][entry[1]];
    if (std::abs(value) <= 1e-9) return;
    refuse(
        "projection[{}] is {}, not 0: the projection is sheared, rotated or has an oblique near "
        "plane",
        4 * entry[0] + entry[1], value);
  };
  for (const auto& entry : kBoth) expectNone(entry);
  for (const auto& entry : orthographic ? kOrthographic : kPerspective) expectNone(entry);
  if (!(matrix[0][0] > 0)) refuse("projection[0] is not over 0: the picture is mirrored");
  if (matrix[1][1] == 0) refuse("projection[5] is 0");
  return {.matrix = matrix, .orthographic = orthographic};
}

void readPixels(const Projection& projection, scene::View& seen) {
  const glm::dmat4& p = projection.matrix;
  seen.orthographic = projection.orthographic;
  const glm::dvec2 slope(p[0][0], p[1][1]);
  // NDC at the view axis.
  const glm::dvec2 axis = projection.orthographic ? glm::dvec2(p[3]) : -glm::dvec2(p[2]);
  seen.scale = glm::dvec2(2, -2) / (slope * glm::dvec2(seen.size));
  seen.offset = (glm::dvec2(-1, 1) - axis) / slope;
}

// How a depth buffer's value becomes view depth. With t the value or, if it grows with distance, 1
// minus the value: perspective x / (t + y), orthographic t x + y. The subtraction from 1 is exact
// where depths crowd.
struct Buffer {
  double x, y;
  bool reversed;
};
Buffer bufferOf(const Projection& projection, uint32_t clip) {
  // Perspective: value = a + b / view depth; orthographic: value = a + b * view depth.
  const glm::dvec2 row(projection.matrix[2][2], projection.matrix[3][2]);
  double a = projection.orthographic ? row.y : -row.x;
  double b = projection.orthographic ? -row.x : row.y;
  if (clip == GRISAILLE_HOST_CLIP_MINUS_ONE_TO_ONE) {
    a = (a + 1) / 2;
    b /= 2;
  }
  if (b == 0) refuse("clip z does not depend on the distance: projection[10] or [14] is wrong");
  if (projection.orthographic) {
    const bool reversed = b < 0;
    return {
        .x = reversed ? 1 / b : -1 / b, .y = reversed ? -a / b : (1 - a) / b, .reversed = reversed};
  }
  const bool reversed = b > 0;
  return {.x = std::abs(b), .y = reversed ? -a : a - 1, .reversed = reversed};
}

// Sets the near and the far plane. Moves an orthographic camera whose near plane is not in front of
// it back along its axis, which does not change the picture. Returns by how many metres.
double readPlanes(const Buffer& buffer, scene::View& seen, double& far) {
  if (seen.orthographic) {
    const double near = buffer.x + buffer.y;
    far = buffer.y;
    if (!(far > near && far - near <= kSky && std::abs(far) <= kSky)) {
      refuse("the orthographic near plane is {} and the far plane {}, not within 1e9 m", near, far);
    }
    const double back = near > 0 ? 0 : (far - near) / 1024 - near;
    seen.eye += back * seen.worldFromView[2];
    seen.nearPlane = near + back;
    seen.farPlane = far + back;
    return back;
  }
  seen.nearPlane = buffer.x / (1 + buffer.y);
  // Rounding of the matrix makes an infinite far plane one behind the camera or very far away.
  far = buffer.y > 1e-12 ? buffer.x / buffer.y : kInfinity;
  if (!(seen.nearPlane > 0 && seen.nearPlane <= kFarthestNear)) {
    refuse("the near plane is {} m, not over 0 and at most 1e6: see grisaille_host_camera.clip",
           seen.nearPlane);
  }
  return 0;
}

// Flags of shaders/host/source.glsl.
uint32_t encodingFlags(uint32_t encoding) {
  constexpr uint32_t kUnsigned = 1, kOctahedral = 4;
  const bool octahedral = encoding >= GRISAILLE_HOST_OCTAHEDRAL_SIGNED;
  const bool isUnsigned =
      encoding == GRISAILLE_HOST_UNSIGNED || encoding == GRISAILLE_HOST_OCTAHEDRAL_UNSIGNED;
  return (isUnsigned ? kUnsigned : 0u) | (octahedral ? kOctahedral : 0u);
}

}  // namespace

grisaille_host_rectangle rectangleOf(const grisaille_host_frame& frame, const glm::uvec2& size) {
  const grisaille_host_rectangle& given = frame.rectangle;
  if (given.x == 0 && given.y == 0 && given.width == 0 && given.height == 0) {
    return {.x = 0, .y = 0, .width = size.x, .height = size.y};
  }
  const bool within = given.width > 0 && given.height > 0 && given.x < size.x && given.y < size.y &&
                      given.width <= size.x - given.x && given.height <= size.y - given.y;
  if (within) return given;
  throw Error(ErrorId::kHostValue,
              "frame.rectangle is {} x {} at {}, {}, and does not lie in the textures of {} x {}",
              given.width, given.height, given.x, given.y, size.x, size.y);
}

View viewOf(const grisaille_host_frame& frame, uint32_t layer,
            const grisaille_host_rectangle& place, uint32_t rows) {
  // Cameras follow one another at the distance of their own version's size.
  const grisaille_host_camera& first = present(frame.camera, "frame.camera");
  const auto* bytes = reinterpret_cast<const std::byte*>(&first);
  const auto* own =
      reinterpret_cast<const grisaille_host_camera*>(bytes + size_t{layer} * first.struct_size);
  if (layer > 0 && own->struct_size != first.struct_size) {
    throw Error(ErrorId::kHostStruct, "frame.camera[{}].struct_size is {}, but that of [0] is {}",
                layer, own->struct_size, first.struct_size);
  }
  const grisaille_host_camera camera = whole(own, "frame.camera");
  checkEnum(camera.clip, 2, "camera.clip");
  checkEnum(frame.depth_kind, 3, "frame.depth_kind");
  checkEnum(frame.normal_space, 2, "frame.normal_space");
  checkEnum(frame.normal_encoding, 4, "frame.normal_encoding");
  View view{};
  scene::View& seen = view.seen;
  seen.size = {place.width, place.height};
  readView(camera, seen);
  const Projection projection = projectionOf(camera);
  readPixels(projection, seen);
  seen.jitter = {camera.jitter[0], camera.jitter[1]};
  for (int i = 0; i < 2; ++i) {
    if (std::abs(seen.jitter[i]) <= 1) continue;
    refuse("jitter[{}] is {} pixels, not from -1 to 1", i, seen.jitter[i]);
  }
  const Buffer buffer = bufferOf(projection, camera.clip);
  double far = 0;
  const double back = readPlanes(buffer, seen, far);

  SourceBlock& source = view.source;
  source.world_from_view = glm::mat4(glm::mat3(seen.worldFromView));
  source.view_from_pixel = glm::vec4(glm::dvec4(seen.scale, seen.offset));
  const double y = buffer.y + (seen.orthographic ? back : 0);
  source.depth = glm::vec4(glm::dvec4(buffer.x, y, std::min(far, kSky), back));
  source.planes = glm::vec4(glm::dvec4(seen.nearPlane, seen.farPlane, 0, 0));
  const bool reversed = frame.depth_kind == GRISAILLE_HOST_DEPTH_BUFFER && buffer.reversed;
  source.mode =
      glm::ivec4(reversed ? kReversedBuffer : static_cast<int>(frame.depth_kind),
                 seen.orthographic ? 1 : 0, rows == GRISAILLE_HOST_ROWS_FROM_BOTTOM ? 1 : 0,
                 encodingFlags(frame.normal_encoding) | frame.normal_space << 1);
  source.place = {place.x, place.y, place.width, place.height};
  return view;
}

MotionBlock motionOf(const grisaille_host_frame& frame, const scene::View& now,
                     const scene::View* then) {
  checkEnum(frame.motion_jittered, 2, "frame.motion_jittered");
  for (const double scale : frame.motion_scale) {
    if (std::isfinite(scale)) continue;
    throw Error(ErrorId::kHostValue, "frame.motion_scale holds {}, must be finite", scale);
  }
  // In pixels of this frame's size.
  scene::View before = then != nullptr ? *then : now;
  const glm::dvec2 zoom = glm::dvec2(before.size) / glm::dvec2(now.size);
  before.scale *= zoom;
  before.jitter /= zoom;
  const glm::dvec2 added = frame.motion_jittered != 0 ? glm::dvec2(0) : before.jitter - now.jitter;
  return {.then_from_view = glm::mat4(scene::thenFromView(before, now)),
          .then_pixel_from_view =
              glm::vec4(glm::dvec4(1.0 / before.scale, -before.offset / before.scale)),
          .shift =
              glm::vec4(glm::dvec4(frame.motion_scale[0], frame.motion_scale[1], added.x, added.y)),
          .known = then != nullptr ? 1.0f : 0.0f,
          .then_orthographic = before.orthographic ? 1.0f : 0.0f};
}

}  // namespace grisaille::host
