/* SPDX-License-Identifier: MIT
 * Runs `ssao` through libgrisaille in an OpenGL context without a window, on the depth of a wall
 * with a deep slit, and prints the mean visibility of the wall and of the slit.
 *   host EFFECT_FOLDER|- */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <grisaille/host.h>
#include <stdio.h>
#include <stdlib.h>

#define SIZE 64
#define GL_TEXTURE_2D 0x0DE1
#define GL_R32F 0x822E
#define GL_RED 0x1903
#define GL_FLOAT 0x1406

static void call(int result) {
  if (result == 0) return;
  fprintf(stderr, "%s\n", grisaille_host_last_error());
  exit(1);
}

static void makeContext(void) {
  PFNEGLGETPLATFORMDISPLAYEXTPROC displayOf =
      (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
  EGLDisplay display = displayOf(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5,
                               EGL_NONE};
  eglInitialize(display, NULL, NULL);
  eglBindAPI(EGL_OPENGL_API);
  EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
  if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) return;
  fprintf(stderr, "no OpenGL 4.5 context\n");
  exit(1);
}

static unsigned depthTexture(void) {
  void (*create)(unsigned, int, unsigned*) =
      (void (*)(unsigned, int, unsigned*))eglGetProcAddress("glCreateTextures");
  void (*allocate)(unsigned, int, unsigned, int, int) =
      (void (*)(unsigned, int, unsigned, int, int))eglGetProcAddress("glTextureStorage2D");
  void (*fill)(unsigned, int, int, int, int, int, unsigned, unsigned, const void*) =
      (void (*)(unsigned, int, int, int, int, int, unsigned, unsigned,
                const void*))eglGetProcAddress("glTextureSubImage2D");
  static float metres[SIZE][SIZE];
  unsigned texture = 0;
  for (int y = 0; y < SIZE; ++y) {
    for (int x = 0; x < SIZE; ++x) metres[y][x] = x / 4 == 8 ? 2.3f : 2.0f;
  }
  create(GL_TEXTURE_2D, 1, &texture);
  allocate(texture, 1, GL_R32F, SIZE, SIZE);
  fill(texture, 0, 0, 0, SIZE, SIZE, GL_RED, GL_FLOAT, metres);
  return texture;
}

int main(int count, char** arguments) {
  if (count != 2) return 2;
  makeContext();
  grisaille_host_opengl opengl = {0};
  opengl.struct_size = sizeof(opengl);
  if (arguments[1][0] != '-') opengl.effect_folder = arguments[1];
  grisaille_host_device* device = NULL;
  call(grisaille_host_device_opengl(&opengl, &device));

  grisaille_host_texture_desc wall = {0};
  wall.struct_size = sizeof(wall);
  wall.image = depthTexture();
  grisaille_host_texture* depth = NULL;
  call(grisaille_host_texture_wrap(device, &wall, &depth));

  grisaille_host_effect_desc desc = {0};
  desc.struct_size = sizeof(desc);
  desc.width = desc.height = SIZE;
  desc.effect = "ssao";
  grisaille_host_effect* ssao = NULL;
  call(grisaille_host_effect_create(device, &desc, &ssao));

  grisaille_host_camera camera = {0};
  camera.struct_size = sizeof(camera);
  camera.view[0] = camera.view[5] = camera.view[10] = camera.view[15] = 1;
  camera.projection[0] = camera.projection[5] = 1;
  camera.projection[11] = -1;
  camera.projection[14] = 0.1; /* reversed, infinite far plane */
  grisaille_host_frame frame = {0};
  frame.struct_size = sizeof(frame);
  frame.depth_kind = GRISAILLE_HOST_DEPTH_VIEW;
  frame.camera = &camera;
  frame.depth = depth;
  call(grisaille_host_effect_record(ssao, &frame));

  grisaille_host_output output = {0};
  output.struct_size = sizeof(output);
  call(grisaille_host_effect_output(ssao, "ao", &output));
  void (*read)(unsigned, int, unsigned, unsigned, int, void*) = (void (*)(
      unsigned, int, unsigned, unsigned, int, void*))eglGetProcAddress("glGetTextureImage");
  static float ao[SIZE][SIZE];
  read((unsigned)output.image, 0, GL_RED, GL_FLOAT, sizeof(ao), ao);
  float open = 0, slit = 0;
  for (int y = 8; y < SIZE - 8; ++y) {
    for (int x = 8; x < 16; ++x) open += ao[y][x] / (8 * (SIZE - 16));
    for (int x = 33; x < 35; ++x) slit += ao[y][x] / (2 * (SIZE - 16));
  }
  printf("version %u, wall %.3f, slit %.3f\n", (unsigned)grisaille_host_version(), (double)open,
         (double)slit);
  call(grisaille_host_effect_destroy(ssao));
  call(grisaille_host_texture_destroy(depth));
  call(grisaille_host_device_destroy(device));
  return 0;
}
