// SPDX-License-Identifier: MIT
// Binding numbers of slot n of each class of resources. grisaille/shader.h has the same numbers.
#define UNIFORM(n) set = 0, binding = (0 + (n))
#define STORAGE(n) set = 0, binding = (16 + (n))
#define TEXTURE(n) set = 0, binding = (32 + (n))
#define IMAGE(n) set = 0, binding = (48 + (n))
