// SPDX-License-Identifier: MIT
// Pictures in a part of the host's textures, in layers of arrays, and in formats of many kinds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <exception>

#include "core/image/image.h"
#include "tests/host/hosts.h"
#include "tests/host/seen.h"
#include "tests/host/vulkan_host.h"

namespace grisaille::tests {
namespace {

using Numbers = std::vector<float>;

Eye eyeOf(double shift = 0) {
  return {.viewFromWorld = glm::lookAt(glm::dvec3(1.2, 1.6, 3.1), glm::dvec3(0.1, 0.5, -0.3),
                                       glm::dvec3(0, 1, 0)),
          .angle = 0.8,
          .shift = glm::dvec2(shift, 0)};
}

host::Camera cameraOf(const Eye& eye, uint32_t width, uint32_t height, const Clip& clip = {}) {
  const glm::dmat4 projection = projectionOf(eye, double{1} * width / height, clip);
  return {&eye.viewFromWorld[0][0], &projection[0][0]};
}

Numbers depthOf(const Eye& eye, uint32_t width, uint32_t height) {
  const Seen seen = see(eye, width, height);
  return {seen.view.begin(), seen.view.end()};
}

// The rectangle of numbers, one a texel. `rows`: how they lie in memory.
Numbers cut(const Numbers& whole, uint32_t width, const grisaille_host_rectangle& part) {
  Numbers numbers;
  for (uint32_t y = 0; y < part.height; ++y) {
    const auto* row = whole.data() + size_t{part.y + y} * width + part.x;
    numbers.insert(numbers.end(), row, row + part.width);
  }
  return numbers;
}

// Puts a picture into a larger one.
void paste(const Numbers& picture, Numbers& whole, uint32_t width,
           const grisaille_host_rectangle& part) {
  for (uint32_t y = 0; y < part.height; ++y) {
    std::copy_n(picture.begin() + size_t{y} * part.width, part.width,
                whole.begin() + size_t{part.y + y} * width + part.x);
  }
}

// Rows in the other order.
Numbers turned(const Numbers& numbers, uint32_t height) {
  Numbers result;
  const auto row = static_cast<ptrdiff_t>(numbers.size() / height);
  for (ptrdiff_t y = height; y > 0; --y) {
    result.insert(result.end(), numbers.begin() + (y - 1) * row, numbers.begin() + y * row);
  }
  return result;
}

class Pictures : public ::testing::TestWithParam<TestDevice> {
 protected:
  Pictures() : host_(makeHost(GetParam())), device_(host_->device(SHOWN_FOLDER)) {}
  ~Pictures() override { EXPECT_EQ(host_->complaints(), 0); }

  // `cameras`: one per layer of the effect.
  void record(host::Effect& effect, const host::Texture& depth, const host::Camera* cameras,
              const grisaille_host_rectangle& part = {}, const host::Texture* motion = nullptr) {
    std::exception_ptr failed;
    host_->frame([&](void* commands, uint64_t number) {
      try {
        effect.record({.number = number,
                       .commandBuffer = commands,
                       .camera = *cameras,
                       .depth = depth,
                       .depthKind = GRISAILLE_HOST_DEPTH_VIEW,
                       .motion = motion,
                       .rectangle = part});
      } catch (...) {
        failed = std::current_exception();  // the host submits nevertheless
      }
    });
    if (failed) std::rethrow_exception(failed);
  }

  std::unique_ptr<Host> host_;
  host::Device device_;
};
GRISAILLE_IN_EVERY_HOST(Pictures);

constexpr uint32_t kWidth = 72, kHeight = 56;
constexpr grisaille_host_rectangle kPart = {.x = 11, .y = 5, .width = 48, .height = 36};

struct Setting {
  const char* key;
  const char* value;
};
const std::vector<std::vector<Setting>> kSettings = {
    {}, {{"resolution", "half"}, {"history", "8"}}, {{"estimator", "classic"}}};

// Bit for bit.
TEST_P(Pictures, APartOfTexturesIsAsAPictureOfItsSize) {
  for (const grisaille_host_rows rows :
       {GRISAILLE_HOST_ROWS_FROM_TOP, GRISAILLE_HOST_ROWS_FROM_BOTTOM}) {
    for (const std::vector<Setting>& settings : kSettings) {
      const Eye eye = eyeOf();
      const auto inRows = [&](const Numbers& numbers) {
        return rows == GRISAILLE_HOST_ROWS_FROM_TOP ? numbers : turned(numbers, kPart.height);
      };
      const Numbers own = inRows(depthOf(eye, kPart.width, kPart.height));
      Numbers whole(size_t{kWidth} * kHeight, 0.7f);  // another scene around it
      paste(own, whole, kWidth, kPart);
      const auto small = host_->texture(device_, Texels::kFloat1, kPart.width, kPart.height, own);
      const auto large = host_->texture(device_, Texels::kFloat1, kWidth, kHeight, whole);
      host::Effect alone(
          device_, {.effect = "ssao", .width = kPart.width, .height = kPart.height, .rows = rows});
      host::Effect part(device_,
                        {.effect = "ssao", .width = kWidth, .height = kHeight, .rows = rows});
      for (host::Effect* effect : {&alone, &part}) {
        for (const Setting& one : settings) effect->set(one.key, one.value);
      }
      const host::Camera camera = cameraOf(eye, kPart.width, kPart.height);
      // What the whole outputs hold before.
      const host::Camera wide = cameraOf(eye, kWidth, kHeight);
      record(part, large, &wide);
      const Numbers before = host_->read(part.output("ao"));
      part.set("radius", 0.6);  // forgets the history
      alone.set("radius", 0.6);
      for (int frame = 0; frame < 3; ++frame) {
        record(alone, small, &camera);
        record(part, large, &camera, kPart);
        const Numbers after = host_->read(part.output("ao"));
        const Numbers expected = host_->read(alone.output("ao"));
        EXPECT_EQ(cut(after, kWidth, kPart), expected) << frame;
        EXPECT_LT(*std::ranges::min_element(expected), 0.9f) << "no pixel is occluded";
        Numbers outside = before;
        paste(expected, outside, kWidth, kPart);
        EXPECT_EQ(after, outside) << "other texels changed";
      }
    }
  }
}

// A resolution that changes each frame, with a history: the memory of the sizes is kept.
TEST_P(Pictures, TheResolutionMayChangeEachFrame) {
  const Eye eye = eyeOf();
  const std::vector<grisaille_host_rectangle> parts = {
      {0, 0, 72, 56}, {0, 0, 63, 49}, {3, 2, 54, 42}, {0, 0, 45, 35}, {9, 9, 36, 28}};
  host::Effect effect(device_, {.effect = "ssao",
                                .width = kWidth,
                                .height = kHeight,
                                .keptSizes = static_cast<uint32_t>(parts.size()) - 1});
  std::vector<uint64_t> bytes;
  for (int frame = 0; frame < 15; ++frame) {
    const grisaille_host_rectangle& part = parts[static_cast<size_t>(frame * 2) % parts.size()];
    Numbers whole(size_t{kWidth} * kHeight, 0.7f);
    const Numbers own = depthOf(eye, part.width, part.height);
    paste(own, whole, kWidth, part);
    const auto large = host_->texture(device_, Texels::kFloat1, kWidth, kHeight, whole);
    const auto small = host_->texture(device_, Texels::kFloat1, part.width, part.height, own);
    const host::Camera camera = cameraOf(eye, part.width, part.height);
    record(effect, large, &camera, part);
    bytes.push_back(effect.memory().device_bytes);
    host::Effect alone(device_, {.effect = "ssao", .width = part.width, .height = part.height});
    record(alone, small, &camera);
    EXPECT_EQ(cut(host_->read(effect.output("ao")), kWidth, part), host_->read(alone.output("ao")))
        << part.width << " x " << part.height;
  }
  // Every size has been seen after as many frames: nothing is created from then on.
  for (size_t frame = parts.size(); frame < bytes.size(); ++frame) {
    EXPECT_EQ(bytes[frame], bytes[parts.size() - 1]) << frame;
  }
  // A history across the sizes: at rest, the result stays close to that of one size.
  effect.set("history", 8);
  host::Effect steady(device_, {.effect = "ssao", .width = kWidth, .height = kHeight});
  steady.set("history", 8);
  const auto full =
      host_->texture(device_, Texels::kFloat1, kWidth, kHeight, depthOf(eye, kWidth, kHeight));
  const host::Camera wide = cameraOf(eye, kWidth, kHeight);
  for (int frame = 0; frame < 9; ++frame) {
    const grisaille_host_rectangle part = frame % 2 == 0 ? parts[0] : parts[1];
    Numbers whole(size_t{kWidth} * kHeight, 0.7f);
    paste(depthOf(eye, part.width, part.height), whole, kWidth, part);
    const auto large = host_->texture(device_, Texels::kFloat1, kWidth, kHeight, whole);
    const host::Camera camera = cameraOf(eye, part.width, part.height);
    record(effect, large, &camera, part);
    record(steady, full, &wide);
  }
  const auto imageOf = [](Numbers numbers) {
    return image::Image{
        .width = kWidth, .height = kHeight, .channels = 1, .pixels = std::move(numbers)};
  };
  const image::Difference difference = image::compare(imageOf(host_->read(effect.output("ao"))),
                                                      imageOf(host_->read(steady.output("ao"))));
  std::printf("%s: history over two sizes: rmse %.4f\n", GetParam().backend.c_str(),
              difference.rmse);
  EXPECT_LT(difference.rmse, 0.03);
}

// Without kept sizes, the memory of one size is held.
TEST_P(Pictures, OtherSizesAreForgottenUnlessTheyAreKept) {
  const Eye eye = eyeOf();
  host::Effect effect(device_, {.effect = "ssao", .width = kWidth, .height = kHeight});
  const auto depth =
      host_->texture(device_, Texels::kFloat1, kWidth, kHeight, depthOf(eye, kWidth, kHeight));
  const auto bytesAt = [&](const grisaille_host_rectangle& part) {
    const host::Camera camera = cameraOf(eye, part.width, part.height);
    for (int frame = 0; frame < 3; ++frame) record(effect, depth, &camera, part);
    return effect.memory().device_bytes;
  };
  const uint64_t large = bytesAt({0, 0, 70, 50}), small = bytesAt({0, 0, 30, 20});
  EXPECT_LT(small, large);
  EXPECT_EQ(bytesAt({0, 0, 70, 50}), large);
  EXPECT_EQ(bytesAt({0, 0, 30, 20}), small);
}

// Bit for bit, over three frames with a history.
TEST_P(Pictures, LayersAreAsSingleRecordings) {
  const Eye eyes[] = {eyeOf(-0.04), eyeOf(0.04)};
  const host::Camera cameras[] = {cameraOf(eyes[0], kWidth, kHeight),
                                  cameraOf(eyes[1], kWidth, kHeight)};
  const Numbers depths[] = {depthOf(eyes[0], kWidth, kHeight), depthOf(eyes[1], kWidth, kHeight)};
  ASSERT_NE(depths[0], depths[1]);
  for (const grisaille_host_rows rows :
       {GRISAILLE_HOST_ROWS_FROM_TOP, GRISAILLE_HOST_ROWS_FROM_BOTTOM}) {
    for (const grisaille_host_rectangle& part : {grisaille_host_rectangle{}, kPart}) {
      Numbers both = depths[0];
      both.insert(both.end(), depths[1].begin(), depths[1].end());
      const auto array = host_->texture(device_, Texels::kFloat1, kWidth, kHeight, both, 2);
      host::TextureSpec second = host_->described();
      second.firstLayer = 1;
      second.layers = 1;
      const host::Texture single[] = {
          host_->texture(device_, Texels::kFloat1, kWidth, kHeight, depths[0]),
          host::Texture(device_, second)};
      const host::EffectSpec spec{
          .effect = "ssao", .width = kWidth, .height = kHeight, .rows = rows};
      host::EffectSpec stereo = spec;
      stereo.layers = 2;
      host::Effect together(device_, stereo), left(device_, spec), right(device_, spec);
      for (host::Effect* effect : {&together, &left, &right}) effect->set("history", 8);
      EXPECT_EQ(together.output("ao").layers, 2u);
      EXPECT_EQ(left.output("ao").layers, 1u);
      for (int frame = 0; frame < 3; ++frame) {
        record(together, array, cameras, part);
        record(left, single[0], &cameras[0], part);
        record(right, single[1], &cameras[1], part);
      }
      const auto shown = [&](const host::Effect& effect, uint32_t layer) {
        const Numbers all = host_->read(effect.output("ao"), layer);
        return part.width > 0 ? cut(all, kWidth, part) : all;
      };
      EXPECT_EQ(shown(together, 0), shown(left, 0));
      EXPECT_EQ(shown(together, 1), shown(right, 0));
      EXPECT_NE(shown(together, 0), shown(together, 1));
    }
  }
}

TEST_P(Pictures, TexturesHaveAsManyLayersAsTheEffect) {
  const Eye eye = eyeOf();
  const host::Camera cameras[] = {cameraOf(eye, 16, 16), cameraOf(eye, 16, 16)};
  const auto depth = host_->texture(device_, Texels::kFloat1, 16, 16, Numbers(256, 2.0f));
  host::Effect effect(device_, {.effect = "ssao", .width = 16, .height = 16, .layers = 2});
  try {
    record(effect, depth, cameras);
    FAIL();
  } catch (const host::Failure& failure) {
    EXPECT_EQ(failure.number(), 5605);
    EXPECT_NE(std::string(failure.what()).find("frame.depth has 1 layers, but the effect has 2"),
              std::string::npos)
        << failure.what();
  }
}

// As vec2 encode(vec3 n) of Meyer et al. 2010.
glm::dvec2 octahedral(const glm::dvec3& normal) {
  const glm::dvec3 n = normal / (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z));
  if (n.z >= 0) return {n.x, n.y};
  return {(1 - std::abs(n.y)) * (n.x >= 0 ? 1 : -1), (1 - std::abs(n.x)) * (n.y >= 0 ? 1 : -1)};
}

// Directions all around, as normals of a wall. The bounds are angles, radians.
TEST_P(Pictures, OctahedralNormalsComeToTheSame) {
  constexpr uint32_t kSide = 64;
  std::vector<glm::dvec3> normals;
  for (uint32_t i = 0; i < kSide * kSide; ++i) {  // a Fibonacci lattice
    const double z = 1 - (2.0 * i + 1) / (kSide * kSide), phi = 2.399963229728653 * i;
    const double r = std::sqrt(1 - z * z);
    normals.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
  }
  const Eye eye = eyeOf();
  const host::Camera camera = cameraOf(eye, kSide, kSide);
  const auto depth =
      host_->texture(device_, Texels::kFloat1, kSide, kSide, Numbers(kSide * kSide, 2.0f));
  host::Effect effect(device_, {.effect = "shown", .width = kSide, .height = kSide});
  const grisaille_host_input inputs[] = {host::inputOf("mask", depth)};
  const auto shown = [&](Texels texels, grisaille_host_encoding encoding, const Numbers& numbers,
                         grisaille_host_normals space) {
    const auto normal = host_->texture(device_, texels, kSide, kSide, numbers);
    host_->frame([&](void* commands, uint64_t number) {
      effect.record({.number = number,
                     .commandBuffer = commands,
                     .camera = camera,
                     .depth = depth,
                     .depthKind = GRISAILLE_HOST_DEPTH_VIEW,
                     .normal = &normal,
                     .normalSpace = space,
                     .normalEncoding = encoding,
                     .inputs = inputs});
    });
    return host_->read(effect.output("shown"));
  };
  const auto worst = [](const Numbers& a, const Numbers& b) {
    double most = 0;
    for (size_t i = 0; i < a.size(); i += 4) {
      const glm::dvec3 one(a[i], a[i + 1], a[i + 2]), other(b[i], b[i + 1], b[i + 2]);
      most = std::max(
          most, std::asin(std::min(
                    1.0, glm::length(glm::cross(glm::normalize(one), glm::normalize(other))))) +
                    (glm::dot(one, other) < 0 ? 2.0 : 0.0));
    }
    return most;
  };
  for (const grisaille_host_normals space :
       {GRISAILLE_HOST_NORMALS_WORLD, GRISAILLE_HOST_NORMALS_VIEW}) {
    Numbers plain, two, three;
    for (const glm::dvec3& normal : normals) {
      for (int c = 0; c < 3; ++c) plain.push_back(static_cast<float>(normal[c]));
      plain.push_back(0);
      const glm::dvec2 at = octahedral(normal) * 0.5 + 0.5;
      for (int c = 0; c < 2; ++c) {
        two.push_back(static_cast<float>(at[c]));
        three.push_back(static_cast<float>(at[c]));
      }
      three.push_back(0);
    }
    const Numbers expected = shown(Texels::kFloat4, GRISAILLE_HOST_SIGNED, plain, space);
    const double half = worst(shown(Texels::kHalf4, GRISAILLE_HOST_SIGNED, plain, space), expected);
    const double rg16 =
        worst(shown(Texels::kUnorm16x2, GRISAILLE_HOST_OCTAHEDRAL_UNSIGNED, two, space), expected);
    const double rgb10 = worst(
        shown(Texels::kUnorm10x3, GRISAILLE_HOST_OCTAHEDRAL_UNSIGNED, three, space), expected);
    const double signedFloats = [&] {
      Numbers numbers;
      for (size_t i = 0; i < two.size(); i += 2) {
        numbers.insert(numbers.end(), {2 * two[i] - 1, 2 * two[i + 1] - 1, 0, 0});
      }
      return worst(shown(Texels::kFloat4, GRISAILLE_HOST_OCTAHEDRAL_SIGNED, numbers, space),
                   expected);
    }();
    std::printf(
        "%s: largest angle to normals in floats: RGBA16F %.5f, RG16 %.5f, RGB10A2 %.5f, "
        "signed floats %.5f\n",
        GetParam().backend.c_str(), half, rg16, rgb10, signedFloats);
    // Attachments are half floats, which round by up to 0.0008 radians.
    EXPECT_LT(half, 0.001);
    EXPECT_LT(signedFloats, 0.001);
    EXPECT_LT(rg16, 0.001);
    EXPECT_LT(rgb10, 0.005);
  }
}

// Depth buffers of all formats, against view depth in floats.
TEST_P(Pictures, DepthBuffersOfAllFormatsComeToTheSame) {
  const Eye eye = eyeOf();
  const Clip clip = {.near = 1, .far = 12};
  const Seen seen = see(eye, kWidth, kHeight);
  const glm::dmat4 projection = projectionOf(eye, double{1} * kWidth / kHeight, clip);
  const host::Camera camera = cameraOf(eye, kWidth, kHeight, clip);
  Numbers buffer;
  for (const double metres : seen.view) {
    const glm::dvec4 p = projection * glm::dvec4(0, 0, -metres, 1);
    buffer.push_back(metres > 0 ? static_cast<float>(p.z / p.w) : 1.0f);
  }
  const auto shade = [&](Texels texels, const Numbers& numbers, grisaille_host_depth kind) {
    const auto depth = host_->texture(device_, texels, kWidth, kHeight, numbers);
    host::Effect effect(device_, {.effect = "ssao", .width = kWidth, .height = kHeight});
    host_->frame([&](void* commands, uint64_t number) {
      effect.record({.number = number,
                     .commandBuffer = commands,
                     .camera = camera,
                     .depth = depth,
                     .depthKind = kind});
    });
    return image::Image{.width = kWidth,
                        .height = kHeight,
                        .channels = 1,
                        .pixels = host_->read(effect.output("ao"))};
  };
  const image::Image expected =
      shade(Texels::kFloat1, {seen.view.begin(), seen.view.end()}, GRISAILLE_HOST_DEPTH_VIEW);
  struct Case {
    Texels texels;
    const char* name;
    double rmse;
  };
  size_t tried = 0;
  for (const Case& one :
       {Case{Texels::kDepth16, "D16", 0.02}, Case{Texels::kDepth24, "D24", 0.005},
        Case{Texels::kDepth24Stencil, "D24S8", 0.005}, Case{Texels::kDepth32, "D32F", 0.005},
        Case{Texels::kDepth32Stencil, "D32FS8", 0.005}}) {
    if (!host_->has(one.texels)) continue;
    ++tried;
    const image::Difference difference =
        image::compare(shade(one.texels, buffer, GRISAILLE_HOST_DEPTH_BUFFER), expected);
    std::printf("%s: %s: rmse %.5f\n", GetParam().backend.c_str(), one.name, difference.rmse);
    EXPECT_EQ(difference.nonFinite, 0u);
    EXPECT_LT(difference.rmse, one.rmse) << one.name;
  }
  EXPECT_GE(tried, 3u);
}

// Textures stay in the layout that the renderer leaves them in.
TEST_P(Pictures, TexturesAreReadInTheirLayouts) {
  if (GetParam().backend != "vulkan") GTEST_SKIP() << "OpenGL has no layouts";
  const Eye eye = eyeOf();
  const Clip clip = {.near = 1, .far = 12};
  const host::Camera camera = cameraOf(eye, kWidth, kHeight, clip);
  Numbers buffer;
  for (const float metres : depthOf(eye, kWidth, kHeight)) {
    buffer.push_back(metres > 0 ? (12 - 12 / metres) / 11 : 1.0f);
  }
  const auto shade = [&](Texels texels, uint32_t layout) {
    useLayout(*host_, layout);
    const auto depth = host_->texture(device_, texels, kWidth, kHeight, buffer);
    host::Effect effect(device_, {.effect = "ssao", .width = kWidth, .height = kHeight});
    for (int frame = 0; frame < 2; ++frame) {
      host_->frame([&](void* commands, uint64_t number) {
        effect.record(
            {.number = number, .commandBuffer = commands, .camera = camera, .depth = depth});
      });
    }
    return host_->read(effect.output("ao"));
  };
  constexpr uint32_t kGeneral = 1, kReadOnly = 1000314000, kAttachment = 1000314001;
  for (const Texels texels : {Texels::kDepth32, Texels::kDepth32Stencil}) {
    const Numbers expected = shade(texels, kGeneral);
    EXPECT_LT(*std::ranges::min_element(expected), 0.9f) << "no pixel is occluded";
    // Of depth attachments, written and read-only; for shaders; and the general names of both.
    for (const uint32_t layout : {3u, 4u, 5u, kReadOnly, kAttachment}) {
      EXPECT_EQ(shade(texels, layout), expected) << layout;
    }
  }
}

// Refused with the error's number, and the value's name.
TEST_P(Pictures, WrongFormatsLayoutsAndPlacesAreRefused) {
  const auto refused = [](int number, const std::string& mention, const auto& call) {
    try {
      call();
      ADD_FAILURE() << mention;
    } catch (const host::Failure& failure) {
      EXPECT_EQ(failure.number(), number) << failure.what();
      EXPECT_NE(std::string(failure.what()).find(mention), std::string::npos) << failure.what();
    }
  };
  const bool isVulkan = GetParam().backend == "vulkan";
  const auto wrapRefused = [&](host::TextureSpec spec, const std::string& mention) {
    refused(5605, mention, [&] { host::Texture(device_, spec); });
  };
  const auto depth = host_->texture(device_, Texels::kDepth32, 16, 16, Numbers(256, 0.5f));
  const host::TextureSpec sound = host_->described();
  host::TextureSpec wrong = sound;
  wrong.firstLayer = 1u << 20;
  wrapRefused(wrong, "layers");
  wrong.firstLayer = 0;
  wrong.layers = 17;
  refused(5611, "desc.layers is 17", [&] { host::Texture(device_, wrong); });
  if (isVulkan) {
    struct Wrong {
      uint32_t format, layout;
      const char* mention;
    };
    for (const Wrong& one :
         {Wrong{55555, sound.layout, "VkFormat 55555"},
          Wrong{sound.format, 55555, "layout 55555 (not a VkImageLayout"},
          Wrong{sound.format, 0, "layout 0 (VK_IMAGE_LAYOUT_UNDEFINED"},
          Wrong{sound.format, 6, "layout 6 (VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL"},
          Wrong{sound.format, 7, "layout 7 (VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL"},
          Wrong{sound.format, 8, "layout 8 (VK_IMAGE_LAYOUT_PREINITIALIZED"},
          Wrong{sound.format, 1000001002, "(VK_IMAGE_LAYOUT_PRESENT_SRC_KHR"},
          Wrong{sound.format, 2,
                "layout 2 (VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL) is not one of images in "
                "VK_FORMAT_D32_SFLOAT"},
          Wrong{100, 3,  // VK_FORMAT_R32_SFLOAT
                "layout 3 (VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL) is not one of"}}) {
      wrong = sound;
      wrong.format = one.format;
      wrong.layout = one.layout;
      wrapRefused(wrong, one.mention);
    }
    for (const uint32_t layout : {1u, 3u, 4u, 5u, 1000117000u, 1000117001u, 1000314000u}) {
      wrong = sound;
      wrong.layout = layout;
      EXPECT_NO_THROW(host::Texture(device_, wrong)) << layout;
    }
  }
  const auto halves = host_->texture(device_, Texels::kHalf4, 16, 16, Numbers(1024, 0.5f));
  const auto pairs = host_->texture(device_, Texels::kUnorm16x2, 16, 16, Numbers(512, 0.5f));
  const auto metres = host_->texture(device_, Texels::kFloat1, 16, 16, Numbers(256, 2.0f));
  host::Effect effect(device_, {.effect = "ssao", .width = 16, .height = 16});
  const host::Camera camera = cameraOf(eyeOf(), 16, 16);
  host_->frame([&](void* commands, uint64_t number) {
    const host::Frame good = {.number = number,
                              .commandBuffer = commands,
                              .camera = camera,
                              .depth = metres,
                              .depthKind = GRISAILLE_HOST_DEPTH_VIEW};
    const host::Frame asDepth = {.number = number,
                                 .commandBuffer = commands,
                                 .camera = camera,
                                 .depth = halves,
                                 .depthKind = GRISAILLE_HOST_DEPTH_VIEW};
    refused(5605,
            std::string("frame.depth has 4 channels (") +
                (isVulkan ? "VK_FORMAT_R16G16B16A16_SFLOAT (97)" : "GL_RGBA16F (0x881a)") +
                "), but takes 1 channel, or a depth format",
            [&] { effect.record(asDepth); });
    host::Frame frame = good;
    frame.normal = &depth;
    refused(5605, "frame.normal has 1 channels", [&] { effect.record(frame); });
    frame.normal = &pairs;
    refused(5605, "frame.normal has 2 channels", [&] { effect.record(frame); });
    frame.normalEncoding = GRISAILLE_HOST_OCTAHEDRAL_UNSIGNED;
    EXPECT_NO_THROW(effect.record(frame));
    for (const grisaille_host_rectangle& part : {grisaille_host_rectangle{0, 0, 17, 4},
                                                 {1, 0, 16, 4},
                                                 {0, 0, 4, 0},
                                                 {16, 0, 1, 1},
                                                 {0, 0xffffffffu, 1, 2},
                                                 {5, 0, 0, 0}}) {
      host::Frame outside = good;
      outside.rectangle = part;
      refused(5611, "frame.rectangle is " + std::to_string(part.width),
              [&] { effect.record(outside); });
    }
    effect.record(good);
  });
}

// An input that the effect cannot do without.
TEST_P(Pictures, AMissingInputIsNamed) {
  host::Effect effect(device_, {.effect = "shown", .width = 16, .height = 16});
  effect.set("what", "mask");
  const host::Camera camera = cameraOf(eyeOf(), 16, 16);
  const auto depth = host_->texture(device_, Texels::kFloat1, 16, 16, Numbers(256, 2.0f));
  const auto mask = host_->texture(device_, Texels::kFloat1, 16, 16, Numbers(256, 0.25f));
  host_->frame([&](void* commands, uint64_t number) {
    const grisaille_host_input other[] = {host::inputOf("task", mask)};
    host::Frame frame = {.number = number,
                         .commandBuffer = commands,
                         .camera = camera,
                         .depth = depth,
                         .depthKind = GRISAILLE_HOST_DEPTH_VIEW};
    for (const std::span<const grisaille_host_input> inputs :
         {std::span<const grisaille_host_input>(), std::span<const grisaille_host_input>(other)}) {
      frame.inputs = inputs;
      try {
        effect.record(frame);
        ADD_FAILURE() << "the input is missing";
      } catch (const host::Failure& failure) {
        EXPECT_EQ(failure.number(), 5610);
        EXPECT_NE(std::string(failure.what())
                      .find("shown needs the input mask, which frame.inputs lacks"),
                  std::string::npos)
            << failure.what();
      }
    }
    const grisaille_host_input given[] = {host::inputOf("mask", mask)};
    frame.inputs = given;
    effect.record(frame);
  });
  const Numbers shown = host_->read(effect.output("shown"));
  for (size_t i = 0; i < shown.size(); i += 4) ASSERT_EQ(shown[i], 0.25f);
}

}  // namespace
}  // namespace grisaille::tests
