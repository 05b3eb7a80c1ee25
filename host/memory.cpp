// SPDX-License-Identifier: MIT
#include "host/memory.h"

#include "host/checks.h"

namespace grisaille::host {
namespace {

class Functions final : public vulkan::MemorySource {
 public:
  explicit Functions(const grisaille_host_allocator& of) : of_(of) {}

  int allocate(const vulkan::ForeignMemoryRequest& request, vulkan::ForeignMemory& out) override {
    const grisaille_host_memory_request wanted = {.struct_size = sizeof(wanted),
                                                  .memory_type_bits = request.typeBits,
                                                  .size = request.size,
                                                  .alignment = request.alignment,
                                                  .required_flags = request.requiredFlags,
                                                  .preferred_flags = request.preferredFlags,
                                                  .buffer = request.buffer,
                                                  .image = request.image,
                                                  .label = request.label};
    grisaille_host_memory memory = {};
    memory.struct_size = sizeof(memory);
    const int result = of_.allocate(of_.context, &wanted, &memory);
    if (result == 0) {
      out = {.memory = memory.memory,
             .offset = memory.offset,
             .mapped = memory.mapped,
             .handle = memory.handle};
    }
    return result;
  }

  void release(const vulkan::ForeignMemory& memory) override {
    const grisaille_host_memory given = {.struct_size = sizeof(given),
                                         .reserved = 0,
                                         .memory = memory.memory,
                                         .offset = memory.offset,
                                         .mapped = memory.mapped,
                                         .handle = memory.handle};
    of_.free(of_.context, &given);
  }

 private:
  const grisaille_host_allocator of_;
};

}  // namespace

std::unique_ptr<vulkan::MemorySource> memorySource(const grisaille_host_allocator* allocator) {
  if (allocator == nullptr) return nullptr;
  const grisaille_host_allocator given = whole(allocator, "allocator");
  checkReserved(given.reserved, "allocator.reserved");
  if (given.allocate == nullptr) throw Error(ErrorId::kHostNull, "allocator.allocate is null");
  if (given.free == nullptr) throw Error(ErrorId::kHostNull, "allocator.free is null");
  return std::make_unique<Functions>(given);
}

}  // namespace grisaille::host
