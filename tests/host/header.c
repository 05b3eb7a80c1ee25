/* SPDX-License-Identifier: MIT
 * Compiles the header as plain C. */
#include "grisaille/host.h"

uint32_t hostVersionInC(void) {
  grisaille_host_camera camera = {0};
  camera.struct_size = sizeof(camera);
  return grisaille_host_version() + (camera.struct_size == 0);
}
