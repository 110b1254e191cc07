#pragma once

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "gpu/core/vulkan_handles.h"

// Device memory; defined in memory.cpp. Only gpu/core/*.cpp and vulkan_*.h include this.
namespace parity::gpu {

struct MemoryBlock;

/// A part of a block of device memory.
struct Allocation {
  MemoryBlock* block = nullptr;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;
  VkDeviceSize bytes = 0;
  std::byte* mapped = nullptr;  ///< null: the host cannot see it
};

enum class MemoryUse {
  fast,     ///< the device's own; the host may not see it
  shared,   ///< the device's own and seen by the host
  staging,  ///< the host's own
};

struct MemoryBlock {
  OwnedMemory memory;
  VkDeviceSize bytes = 0;
  std::uint32_t type = 0;
  bool for_buffers = false;
  std::byte* mapped = nullptr;
  std::map<VkDeviceSize, VkDeviceSize> free;  ///< offset to size
};

/// Hands out parts of larger allocations: drivers limit how many there are.
class MemoryPool {
 public:
  MemoryPool(const DeviceLink& link, VkPhysicalDevice physical);

  /// @throws Error  (out_of_memory) the heap is smaller than what would then be in use.
  Allocation allocate(const VkMemoryRequirements& needs, MemoryUse use, bool for_buffers);
  void free(const Allocation& allocation);
  std::optional<std::uint32_t> find_type(std::uint32_t allowed, VkMemoryPropertyFlags required,
                                         VkMemoryPropertyFlags preferred) const;

 private:
  std::uint32_t choose_type(std::uint32_t allowed, MemoryUse use) const;
  MemoryBlock& new_block(std::uint32_t type, VkDeviceSize bytes, bool for_buffers);

  const DeviceLink& link_;
  VkPhysicalDeviceMemoryProperties properties_{};
  std::list<MemoryBlock> blocks_;
  std::vector<VkDeviceSize> heap_used_;
};

/// Owns an allocation of a pool.
class OwnedAllocation {
 public:
  OwnedAllocation() = default;
  OwnedAllocation(MemoryPool& pool, const Allocation& allocation)
      : pool_(&pool), allocation_(allocation) {}
  ~OwnedAllocation() {
    if (pool_ != nullptr) pool_->free(allocation_);
  }
  OwnedAllocation(OwnedAllocation&& other) noexcept
      : pool_(std::exchange(other.pool_, nullptr)), allocation_(other.allocation_) {}
  OwnedAllocation& operator=(OwnedAllocation&& other) noexcept {
    std::swap(pool_, other.pool_);
    std::swap(allocation_, other.allocation_);
    return *this;
  }
  const Allocation& get() const { return allocation_; }

 private:
  MemoryPool* pool_ = nullptr;
  Allocation allocation_;
};

}  // namespace parity::gpu
