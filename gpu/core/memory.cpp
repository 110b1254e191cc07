#include <algorithm>

#include "gpu/core/vulkan_state.h"

namespace parity::gpu {
namespace {

constexpr VkDeviceSize block_bytes = VkDeviceSize{8} << 20;

VkDeviceSize align(VkDeviceSize value, VkDeviceSize alignment) {
  return (value + alignment - 1) / alignment * alignment;
}

/// Takes the first free range that is large enough.
std::optional<VkDeviceSize> take(MemoryBlock& block, VkDeviceSize bytes, VkDeviceSize alignment) {
  for (auto range = block.free.begin(); range != block.free.end(); ++range) {
    const auto [offset, size] = *range;
    const VkDeviceSize start = align(offset, alignment);
    if (start - offset > size || size - (start - offset) < bytes) continue;
    block.free.erase(range);
    if (start > offset) block.free[offset] = start - offset;
    const VkDeviceSize end = start + bytes;
    if (end < offset + size) block.free[end] = offset + size - end;
    return start;
  }
  return std::nullopt;
}

/// Gives a range back and joins it to its neighbours.
void give_back(MemoryBlock& block, VkDeviceSize offset, VkDeviceSize bytes) {
  auto after = block.free.lower_bound(offset);
  if (after != block.free.end() && after->first == offset + bytes) {
    bytes += after->second;
    after = block.free.erase(after);
  }
  if (after != block.free.begin()) {
    const auto before = std::prev(after);
    if (before->first + before->second == offset) {
      before->second += bytes;
      return;
    }
  }
  block.free[offset] = bytes;
}

std::string mebibytes(VkDeviceSize bytes) { return std::to_string(bytes >> 20) + " MiB"; }

}  // namespace

MemoryPool::MemoryPool(const DeviceLink& link, VkPhysicalDevice physical) : link_(link) {
  vkGetPhysicalDeviceMemoryProperties(physical, &properties_);
  heap_used_.assign(properties_.memoryHeapCount, 0);
}

std::optional<std::uint32_t> MemoryPool::find_type(std::uint32_t allowed,
                                                   VkMemoryPropertyFlags required,
                                                   VkMemoryPropertyFlags preferred) const {
  std::optional<std::uint32_t> found;
  for (std::uint32_t i = 0; i < properties_.memoryTypeCount; ++i) {
    const VkMemoryPropertyFlags flags = properties_.memoryTypes[i].propertyFlags;
    if ((allowed & (1u << i)) == 0 || (flags & required) != required) continue;
    if ((flags & preferred) == preferred) return i;
    if (!found) found = i;
  }
  return found;
}

std::uint32_t MemoryPool::choose_type(std::uint32_t allowed, MemoryUse use) const {
  constexpr VkMemoryPropertyFlags host =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  constexpr VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
  constexpr VkMemoryPropertyFlags cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
  std::optional<std::uint32_t> type;
  if (use == MemoryUse::fast) type = find_type(allowed, 0, local);
  if (use == MemoryUse::shared) type = find_type(allowed, host, local | cached);
  if (use == MemoryUse::staging) type = find_type(allowed, host, cached);
  if (!type)
    throw Error(ErrorKind::missing_feature, "the device has no memory of the kind that is needed");
  return *type;
}

MemoryBlock& MemoryPool::new_block(std::uint32_t type, VkDeviceSize bytes, bool for_buffers) {
  const std::uint32_t heap = properties_.memoryTypes[type].heapIndex;
  const VkDeviceSize heap_bytes = properties_.memoryHeaps[heap].size;
  if (bytes > heap_bytes || heap_used_[heap] > heap_bytes - bytes)
    throw Error(ErrorKind::out_of_memory, "out of device memory: " + mebibytes(bytes) + " more, " +
                                              mebibytes(heap_used_[heap]) + " of " +
                                              mebibytes(heap_bytes) + " in use");
  VkMemoryAllocateFlagsInfo flags{};
  flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.pNext = for_buffers ? &flags : nullptr;
  info.allocationSize = bytes;
  info.memoryTypeIndex = type;
  MemoryBlock block;
  block.memory = create<OwnedMemory>(link_, vkAllocateMemory, info, "vkAllocateMemory");
  if ((properties_.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0) {
    void* mapped = nullptr;
    check(vkMapMemory(link_.device, block.memory.get(), 0, VK_WHOLE_SIZE, 0, &mapped),
          "vkMapMemory");
    block.mapped = static_cast<std::byte*>(mapped);
  }
  block.bytes = bytes;
  block.type = type;
  block.for_buffers = for_buffers;
  block.free[0] = bytes;
  blocks_.push_back(std::move(block));
  heap_used_[heap] += bytes;
  return blocks_.back();
}

Allocation MemoryPool::allocate(const VkMemoryRequirements& needs, MemoryUse use,
                                bool for_buffers) {
  const std::uint32_t type = choose_type(needs.memoryTypeBits, use);
  const auto from = [&](MemoryBlock& block) -> std::optional<Allocation> {
    const std::optional<VkDeviceSize> offset = take(block, needs.size, needs.alignment);
    if (!offset) return std::nullopt;
    return Allocation{.block = &block,
                      .memory = block.memory.get(),
                      .offset = *offset,
                      .bytes = needs.size,
                      .mapped = block.mapped == nullptr ? nullptr : block.mapped + *offset};
  };
  for (MemoryBlock& block : blocks_)
    if (block.type == type && block.for_buffers == for_buffers)
      if (const std::optional<Allocation> found = from(block)) return *found;
  const bool large = needs.size > block_bytes / 4;
  return from(new_block(type, large ? needs.size : block_bytes, for_buffers)).value();
}

void MemoryPool::free(const Allocation& allocation) {
  MemoryBlock& block = *allocation.block;
  give_back(block, allocation.offset, allocation.bytes);
  const bool empty = block.free.size() == 1 && block.free.begin()->second == block.bytes;
  // An empty block of the usual size stays, for the next small allocation.
  if (!empty || block.bytes == block_bytes) return;
  heap_used_[properties_.memoryTypes[block.type].heapIndex] -= block.bytes;
  blocks_.remove_if([&](const MemoryBlock& each) { return &each == &block; });
}

}  // namespace parity::gpu
