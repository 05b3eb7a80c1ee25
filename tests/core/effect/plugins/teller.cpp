// SPDX-License-Identifier: MIT
// An effect with objects of every field type. It casts rays and reads pictures, correctly or with
// faults, and writes its inputs to the output. -DLATER builds a later version of the plugin, see
// mark.h.
#include "mark.h"

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "grisaille/effect.hpp"

namespace {

namespace plugin = grisaille::plugin;
using grisaille::tests::Mark;

enum Parameter { kCasts, kWaits, kGivesUp, kCoarser, kPicture, kFails, kDraws, kDepth };

constexpr const char* kCastKeys[] = {"none",          "two",      "nan_origin", "long_direction",
                                     "nan_direction", "no_reach", "nan_reach",  "null"};
constexpr const char* kDepthKeys[] = {"none",       "two",     "nan_origin", "long_direction",
                                      "tilted_up",  "long_up", "no_slope",   "no_size",
                                      "large_size", "null"};
constexpr const char* kDrawKeys[] = {"well", "alpha", "owner", "colour"};
constexpr const char* kPictureKeys[] = {"none", "last", "null"};
constexpr grisaille_param_desc kParams[] = {
    plugin::enumParam({.key = "casts",
                       .label = "Casts",
                       .tooltip = "Which rays, the second of two being at fault",
                       .keys = kCastKeys,
                       .labels = kCastKeys}),
    plugin::intParam({.key = "waits",
                      .label = "Waits",
                      .tooltip = "What it says that waits; under 0: nothing",
                      .hardMin = -1,
                      .hardMax = 100,
                      .softMin = -1,
                      .softMax = 100,
                      .defaultValue = -1}),
    plugin::intParam({.key = "gives_up",
                      .label = "Gives up",
                      .tooltip = "Objects that it says it gives up; under 0: it says nothing",
                      .hardMin = -1,
                      .hardMax = 100,
                      .softMin = -1,
                      .softMax = 100,
                      .defaultValue = -1}),
    plugin::intParam({.key = "coarser",
                      .label = "Coarser",
                      .tooltip = "Objects that it says are coarser; under 0: it says nothing",
                      .hardMin = -1,
                      .hardMax = 100,
                      .softMin = -1,
                      .softMax = 100,
                      .defaultValue = -1}),
    plugin::enumParam({.key = "picture",
                       .label = "Picture",
                       .tooltip = "Which picture it reads: that of the last object, or a null path",
                       .keys = kPictureKeys,
                       .labels = kPictureKeys}),
    plugin::boolParam({.key = "fails", .label = "Fails", .tooltip = "Fails in both functions"}),
    plugin::enumParam({.key = "draws",
                       .label = "Draws",
                       .tooltip = "What of the last point it draws beyond its range",
                       .keys = kDrawKeys,
                       .labels = kDrawKeys}),
    plugin::enumParam({.key = "depth",
                       .label = "Depth",
                       .tooltip = "Which depth picture of 2 x 2 pixels it asks for, or which fault",
                       .keys = kDepthKeys,
                       .labels = kDepthKeys})};

constexpr grisaille_output_desc kOutputs[] = {plugin::output(
    {.key = "told", .format = GRISAILLE_FORMAT_R32F, .tooltip = "What it was told"})};

constexpr grisaille_field_desc kFields[] = {plugin::field({.key = "position",
                                                           .label = "Position",
                                                           .tooltip = "Where it is",
                                                           .type = GRISAILLE_FIELD_POINT,
                                                           .offset = offsetof(Mark, position),
                                                           .required = true}),
                                            plugin::field({.key = "direction",
                                                           .label = "Direction",
                                                           .tooltip = "Where it looks",
                                                           .type = GRISAILLE_FIELD_DIRECTION,
                                                           .offset = offsetof(Mark, direction),
                                                           .defaults = {0, 0, -1}}),
#ifdef LATER
                                            plugin::field({.key = "colour",
                                                           .label = "Colour",
                                                           .tooltip = "Its name",
                                                           .type = GRISAILLE_FIELD_TEXT,
                                                           .offset = offsetof(Mark, colour),
                                                           .text = "red"}),
#else
                                            plugin::field({.key = "colour",
                                                           .label = "Colour",
                                                           .tooltip = "Linear",
                                                           .type = GRISAILLE_FIELD_COLOUR,
                                                           .offset = offsetof(Mark, colour),
                                                           .defaults = {1, 0.5, 0}}),
#endif
                                            plugin::field({.key = "size",
                                                           .label = "Size",
                                                           .unit = "m",
                                                           .tooltip = "How large it is",
                                                           .type = GRISAILLE_FIELD_NUMBER,
                                                           .offset = offsetof(Mark, size),
                                                           .min = -1,
                                                           .max = grisaille::tests::kLargestMark,
                                                           .defaults = {0.25}}),
#ifdef LATER
                                            plugin::field({.key = "weight",
                                                           .label = "Weight",
                                                           .tooltip = "How heavy it is",
                                                           .type = GRISAILLE_FIELD_NUMBER,
                                                           .offset = offsetof(Mark, weight),
                                                           .max = 1,
                                                           .defaults = {0.5}}),
#else
                                            plugin::field({.key = "note",
                                                           .label = "Note",
                                                           .tooltip = "Any words",
                                                           .type = GRISAILLE_FIELD_TEXT,
                                                           .offset = offsetof(Mark, note),
                                                           .text = "none"}),
#endif
                                            plugin::field({.key = "picture",
                                                           .label = "Picture",
                                                           .tooltip = "A file",
                                                           .type = GRISAILLE_FIELD_FILE,
                                                           .offset = offsetof(Mark, picture),
                                                           .text = ""})};

constexpr auto kMarks = plugin::objects<Mark>({.key = "marks",
                                               .label = "Marks",
                                               .tooltip = "What a user leaves behind",
                                               .fields = kFields,
                                               .placement = GRISAILLE_PLACE_SURFACE,
                                               .pointField = 0,
                                               .directionField = 1});

// Texels of the output: number of objects, number kept, patience, the last object's x, whether rays
// can be cast, kind and distance of two hits, width and first byte of the picture, the frame's
// index, whether depth pictures are drawn, the last depth.
class Teller {
 public:
  explicit Teller(plugin::Host host) : host_(host) {}

  static uint32_t reads(plugin::Values, uint32_t) noexcept { return 0; }

  // Draws at each point: number of objects and of those kept, in hundredths; whether rays can be
  // cast; the last object.
  void drawAt(const plugin::Points& points) {
    if (points.value<bool>(kFails)) throw plugin::Failure("told to fail");
    const auto marks = points.objects<Mark>();
    std::array<grisaille_hit, 2> hits = {};
    const bool casts = cast(points.value<int32_t>(kCasts), hits);
    for (grisaille_drawn& drawn : points.drawn()) {
      drawn = {.colour = {0.01f * static_cast<float>(marks.size()),
                          0.01f * static_cast<float>(points.objectsKept()), casts ? 1.0f : 0.0f},
               .alpha = 1,
               .owner = marks.size()};
    }
    const int32_t wrong = points.value<int32_t>(kDraws);
    if (wrong == 1) points.drawn().back().alpha = NAN;
    if (wrong == 2) points.drawn().back().owner = marks.size() + 1;
    if (wrong == 3) points.drawn().back().colour[1] = 1.5f;
  }

  void record(const plugin::Frame& frame) {
    if (frame.value<bool>(kFails)) throw plugin::Failure("told to fail");
    const int32_t waits = frame.value<int32_t>(kWaits);
    if (waits >= 0) frame.waiting(static_cast<uint64_t>(waits));
    const int32_t givesUp = frame.value<int32_t>(kGivesUp);
    if (givesUp >= 0) frame.givenUp(static_cast<uint64_t>(givesUp));
    const int32_t coarser = frame.value<int32_t>(kCoarser);
    if (coarser >= 0) frame.coarser(static_cast<uint64_t>(coarser));
    std::vector<float> told(size_t{frame.width()} * frame.height());
    const auto marks = frame.objects<Mark>();
    told[0] = static_cast<float>(marks.size());
    told[1] = static_cast<float>(frame.objectsKept());
    told[2] = static_cast<float>(frame.patience());
    told[3] = marks.empty() ? 0 : static_cast<float>(marks.back().position[0]);
    std::array<grisaille_hit, 2> hits = {};
    told[4] = cast(frame.value<int32_t>(kCasts), hits) ? 1 : 0;
    for (size_t i = 0; i < hits.size(); ++i) {
      told[5 + 2 * i] = static_cast<float>(hits[i].kind);
      told[6 + 2 * i] = hits[i].distance;
    }
    const uint32_t which = frame.value<uint32_t>(kPicture);
    if (which != 0) {
      const auto picture = host_.readPicture(which == 1 ? marks.back().picture : nullptr);
      told[9] = picture ? static_cast<float>(picture->width) : -1;
      told[10] = picture ? picture->rgba[0] : 0;
    }
    told[11] = static_cast<float>(frame.index());
    std::array<float, 4> depth = {};
    told[12] = draw(frame.value<int32_t>(kDepth), depth) ? 1 : 0;
    told[13] = depth[3];
    if (frame.wanted(0)) frame.uploadTexture(frame.output(0), told);
  }

 private:
  bool cast(int32_t which, std::array<grisaille_hit, 2>& hits) const {
    std::array<grisaille_ray, 2> rays = {
        {{{1, 2, 3}, {0, 1, 0}, INFINITY}, {{0, 0, 0}, {0, 0, -1}, 5}}};
    switch (which) {
      case 0:
        return false;
      case 2:
        rays[1].origin[2] = NAN;
        break;
      case 3:
        rays[1].direction[2] = 1.0011f;
        break;
      case 4:
        rays[1].direction[0] = NAN;
        break;
      case 5:
        rays[1].reach = 0;
        break;
      case 6:
        rays[1].reach = NAN;
        break;
      case 7:
        return host_.castRays({static_cast<grisaille_ray*>(nullptr), 2}, hits);
      default:
        rays[1].direction[2] = -1.0009f;
    }
    return host_.castRays(rays, hits);
  }

  bool draw(int32_t which, std::array<float, 4>& depth) const {
    if (which == 0) return false;
    grisaille_depth_view view = {
        .origin = {1, 2, 3}, .direction = {0, 0, -1}, .up = {0, 1, 0}, .slope = 0.5f, .size = 2};
    const std::string_view fault = kDepthKeys[which];
    if (fault == "nan_origin") view.origin[1] = NAN;
    if (fault == "long_direction") view.direction[2] = -1.0011f;
    if (fault == "tilted_up") view.up[2] = 0.002f;
    if (fault == "long_up") view.up[1] = 1.0011f;
    if (fault == "no_slope") view.slope = 0;
    if (fault == "no_size") view.size = 0;
    if (fault == "large_size") view.size = 4097;
    return host_.drawDepth(view, fault == "null" ? std::span<float>() : std::span(depth));
  }

  plugin::Host host_;
};

constexpr auto kTeller = plugin::effect<Teller>({.key = "teller",
                                                 .label = "Teller",
                                                 .version = "1.0.0",
                                                 .tooltip = "Tells what it was given",
                                                 .params = kParams,
                                                 .outputs = kOutputs,
                                                 .objects = &kMarks});

}  // namespace

GRISAILLE_EXPORT_PLUGIN(&kTeller);
