// SPDX-License-Identifier: MIT
#include "app/viewer/interface.h"

#include <imgui/imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "shaders/interface_frag.h"
#include "shaders/interface_vert.h"

namespace grisaille::app::viewer {
namespace {

constexpr float kTextPixels = 16;

// Same layout as in shaders/viewer/interface.vert.
struct InterfaceBlock {
  float clip_from_unit[2];
  float origin[2];
};
GRISAILLE_CHECK_BLOCK_interface_vert_Interface(InterfaceBlock);

// Scalable fonts, the first that exists; ImGui's built-in font is a bitmap.
constexpr const char* kFonts[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                  "/usr/share/fonts/TTF/DejaVuSans.ttf",
                                  "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf"};

// One accent colour marks whatever the user can press or drag; its strength says what it does.
void setAccent(ImGuiStyle& style, bool light) {
  const ImVec4 accent = light ? ImVec4(0.05f, 0.40f, 0.66f, 1) : ImVec4(0.26f, 0.59f, 0.98f, 1);
  const auto set = [&](ImGuiCol colour, float strength) {
    style.Colors[colour] = ImVec4(accent.x, accent.y, accent.z, strength);
  };
  const float weak = light ? 0.16f : 0.25f;
  set(ImGuiCol_FrameBg, weak);
  set(ImGuiCol_FrameBgHovered, 0.40f);
  set(ImGuiCol_FrameBgActive, 0.60f);
  set(ImGuiCol_Button, 0.40f);
  set(ImGuiCol_ButtonHovered, 0.75f);
  set(ImGuiCol_ButtonActive, 1);
  set(ImGuiCol_Header, 0.31f);
  set(ImGuiCol_HeaderHovered, 0.60f);
  set(ImGuiCol_HeaderActive, 0.80f);
  set(ImGuiCol_CheckMark, 1);
  set(ImGuiCol_SliderGrab, 0.80f);
  set(ImGuiCol_SliderGrabActive, 1);
  set(ImGuiCol_SeparatorHovered, 0.78f);
  set(ImGuiCol_SeparatorActive, 1);
  set(ImGuiCol_TextSelectedBg, 0.35f);
  set(ImGuiCol_NavHighlight, 1);
  set(ImGuiCol_PlotHistogram, 0.80f);
  set(ImGuiCol_TitleBgActive, light ? 0.35f : 0.45f);
}

void setStyle(float scale, bool light) {
  ImGuiStyle style;
  light ? ImGui::StyleColorsLight(&style) : ImGui::StyleColorsDark(&style);
  setAccent(style, light);
  style.WindowRounding = style.FrameRounding = style.GrabRounding = 3;
  style.WindowBorderSize = 0;
  style.Colors[ImGuiCol_WindowBg].w = 1;
  // Nothing but the picture, white or black, lies behind a title.
  ImVec4& title = style.Colors[ImGuiCol_TitleBgActive];
  const ImVec4& ground = style.Colors[ImGuiCol_WindowBg];
  title = {std::lerp(ground.x, title.x, title.w), std::lerp(ground.y, title.y, title.w),
           std::lerp(ground.z, title.z, title.w), 1};
  // Hints and reasons are read, too.
  style.Colors[ImGuiCol_TextDisabled] =
      light ? ImVec4(0.38f, 0.38f, 0.38f, 1) : ImVec4(0.62f, 0.62f, 0.62f, 1);
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

}  // namespace

InterfaceContext::InterfaceContext() {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // do not save the panel's position
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  io.ConfigInputTextCursorBlink = false;  // a blinking cursor would need frames
  io.ConfigDragClickToInputText = true;   // a click on a slider opens a text field
}

InterfaceContext::~InterfaceContext() {
  ImGui::DestroyContext();
}

bool InterfaceContext::setScale(float scale) {
  scale = std::clamp(scale, kSmallestText, 2 * kLargestText);
  if (scale == scale_) return false;
  scale_ = scale;
  setStyle(scale, light_);
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.Clear();
  const float pixels = std::round(kTextPixels * scale);
  const ImWchar ranges[] = {0x20, 0xff, 0x2000, 0x206f, 0x2190, 0x21ff, 0x2200, 0x22ff, 0};
  const auto file = std::ranges::find_if(kFonts, [](const char* path) {
    std::error_code failed;
    return std::filesystem::exists(path, failed);
  });
  if (file == std::end(kFonts) ||
      fonts.AddFontFromFileTTF(*file, pixels, nullptr, ranges) == nullptr) {
    ImFontConfig config;
    config.SizePixels = pixels;
    fonts.AddFontDefault(&config);
  }
  fonts.Build();
  return true;
}

void InterfaceContext::setLight(bool light) {
  if (light == light_) return;
  light_ = light;
  if (scale_ > 0) setStyle(scale_, light_);
}

ImVec4 readable(ImVec4 colour) {
  constexpr float kDarker = 0.55f;
  if (ImGui::GetStyleColorVec4(ImGuiCol_WindowBg).x < 0.5f) return colour;
  return {kDarker * colour.x, kDarker * colour.y, kDarker * colour.z, colour.w};
}

ImVec4 errorColour() {
  return readable({0.90f, 0.62f, 0.00f, 1});
}

InterfaceRenderer::~InterfaceRenderer() {
  device_.destroy(pipeline_);
  device_.destroy(picturesPipeline_);
  device_.destroy(pictures_);
  device_.destroy(sampler_);
  device_.destroy(font_);
  device_.destroy(vertices_);
  device_.destroy(indices_);
}

void InterfaceRenderer::fontChanged() {
  device_.destroy(font_);
  font_ = {};
}

void InterfaceRenderer::uploadFont(gpu::Commands& commands) {
  if (font_) return;
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&pixels, &width, &height);
  font_ = device_.createTexture({.label = "font",
                                 .format = gpu::Format::kR8Unorm,
                                 .width = static_cast<uint32_t>(width),
                                 .height = static_cast<uint32_t>(height),
                                 .usage = gpu::TextureUsage::kSampled});
  const size_t bytes = static_cast<size_t>(width) * static_cast<size_t>(height);
  commands.upload(font_, 0, 0, std::as_bytes(std::span(pixels, bytes)));
}

// Joins all draw lists into one array of vertices and one of 32-bit indices into the whole array.
void InterfaceRenderer::gather(const ImDrawData& data) {
  vertexData_.clear();
  indexData_.clear();
  for (int i = 0; i < data.CmdListsCount; ++i) {
    const ImDrawList& list = *data.CmdLists[i];
    const auto base = static_cast<uint32_t>(vertexData_.size() / sizeof(ImDrawVert));
    const auto bytes = std::as_bytes(std::span(list.VtxBuffer.Data, list.VtxBuffer.size()));
    vertexData_.insert(vertexData_.end(), bytes.begin(), bytes.end());
    for (const ImDrawCmd& command : list.CmdBuffer) {
      for (uint32_t k = 0; k < command.ElemCount; ++k) {
        const ImDrawIdx index = list.IdxBuffer[static_cast<int>(command.IdxOffset + k)];
        indexData_.push_back(base + command.VtxOffset + index);
      }
    }
  }
}

gpu::Buffer InterfaceRenderer::buffer(gpu::Commands& commands, gpu::Buffer& buffer,
                                      uint64_t& capacity, const char* label,
                                      std::span<const std::byte> bytes, gpu::BufferUsage usage) {
  if (capacity < bytes.size()) {
    device_.destroy(buffer);
    capacity = bytes.size() + bytes.size() / 2;
    buffer = device_.createBuffer({.label = label, .size = capacity, .usage = usage});
  }
  commands.upload(buffer, 0, bytes);
  return buffer;
}

ImTextureID picturesTexture() {
  // A number or a pointer, by ImGui's version. The font has 0.
  return (ImTextureID)(intptr_t)1;  // NOLINT(google-readability-casting)
}

gpu::GraphicsPipeline InterfaceRenderer::makePipeline(bool pictures) {
  constexpr uint32_t kStride[] = {sizeof(ImDrawVert)};
  constexpr gpu::VertexAttribute kAttributes[] = {
      {0, 0, gpu::AttributeFormat::kFloat2, offsetof(ImDrawVert, pos)},
      {1, 0, gpu::AttributeFormat::kFloat2, offsetof(ImDrawVert, uv)},
      {2, 0, gpu::AttributeFormat::kUnorm8x4, offsetof(ImDrawVert, col)}};
  constexpr gpu::Format kFormat[] = {gpu::Format::kRgba8Unorm};
  const gpu::Specialization constants[] = {{0, pictures ? 1u : 0u}};
  gpu::GraphicsPipelineDesc desc;
  desc.label = "interface";
  desc.vertex = &grisaille_shader_interface_vert;
  desc.fragment = &grisaille_shader_interface_frag;
  desc.constants = constants;
  desc.streamStrides = kStride;
  desc.attributes = kAttributes;
  desc.colorFormats = kFormat;
  desc.blend = gpu::Blend::kOver;
  return device_.createGraphicsPipeline(desc);
}

void InterfaceRenderer::uploadPictures(gpu::Commands& commands, const InterfacePictures& pictures) {
  device_.destroy(pictures_);
  pictures_ = {};
  if (!picturesPipeline_) picturesPipeline_ = makePipeline(true);
  pictures_ = device_.createTexture({.label = "pictures",
                                     .format = gpu::Format::kRgba8Unorm,
                                     .width = pictures.width,
                                     .height = pictures.height,
                                     .usage = gpu::TextureUsage::kSampled});
  commands.upload(pictures_, 0, 0, pictures.texels);
  picturesRevision_ = pictures.revision;
}

void InterfaceRenderer::draw(gpu::Commands& commands, const ImDrawData& data, gpu::Texture target,
                             uint32_t width, uint32_t height, const InterfacePictures* pictures) {
  gather(data);
  if (indexData_.empty()) return;
  if (!pipeline_) {
    sampler_ = device_.createSampler({.label = "interface", .filter = gpu::Filter::kLinear});
    pipeline_ = makePipeline(false);
  }
  if (pictures != nullptr && picturesRevision_ != pictures->revision) {
    uploadPictures(commands, *pictures);
  }
  uploadFont(commands);
  const gpu::BufferRange vertexRange = {buffer(commands, vertices_, vertexBytes_,
                                               "interface vertices", vertexData_,
                                               gpu::BufferUsage::kVertex)};
  const gpu::BufferRange indexRange = {buffer(commands, indices_, indexBytes_, "interface indices",
                                              std::as_bytes(std::span(indexData_)),
                                              gpu::BufferUsage::kIndex)};
  const InterfaceBlock block = {{2 / data.DisplaySize.x, 2 / data.DisplaySize.y},
                                {data.DisplayPos.x, data.DisplayPos.y}};
  const std::array bindings = {
      gpu::uniformBinding(0, commands.uniform(std::as_bytes(std::span(&block, 1)))),
      gpu::textureBinding(0, {.texture = font_}, sampler_)};
  const std::array pictured = {bindings[0],
                               gpu::textureBinding(0, {.texture = pictures_}, sampler_)};
  std::vector<gpu::Draw> draws;
  uint32_t first = 0;
  const ImVec2 scale = data.FramebufferScale;
  const auto clip = [](float value, uint32_t most) {
    return static_cast<uint32_t>(std::clamp(value, 0.0f, static_cast<float>(most)));
  };
  for (int i = 0; i < data.CmdListsCount; ++i) {
    for (const ImDrawCmd& command : data.CmdLists[i]->CmdBuffer) {
      const uint32_t left = clip((command.ClipRect.x - data.DisplayPos.x) * scale.x, width);
      const uint32_t top = clip((command.ClipRect.y - data.DisplayPos.y) * scale.y, height);
      const uint32_t right = clip((command.ClipRect.z - data.DisplayPos.x) * scale.x, width);
      const uint32_t bottom = clip((command.ClipRect.w - data.DisplayPos.y) * scale.y, height);
      if (right > left && bottom > top && command.ElemCount > 0) {
        gpu::Draw draw;
        const bool picture = pictures_ && command.GetTexID() == picturesTexture();
        draw.pipeline = picture ? picturesPipeline_ : pipeline_;
        draw.bindings = picture ? pictured : bindings;
        draw.vertexStreams = {&vertexRange, 1};
        draw.indices = indexRange;
        draw.count = command.ElemCount;
        draw.first = first;
        draw.scissor = {left, top, right - left, bottom - top};
        draws.push_back(draw);
      }
      first += command.ElemCount;
    }
  }
  gpu::ColorTarget color;
  color.view = {.texture = target};
  color.load = gpu::Load::kLoad;
  commands.render({.colors = {&color, 1}, .draws = draws});
}

}  // namespace grisaille::app::viewer
