// SPDX-License-Identifier: Apache-2.0
#include "sim/files/image_library.hpp"

#include "sim/os/shared_library.hpp"

namespace halfway {

Result<ImageLibrary> image_library() {
  static const auto& library = *new Result<SharedLibrary>(SharedLibrary::load(HALFWAY_IMAGES));
  if (!library) return library.error();
  ImageLibrary found;
  const Status bound = library->bind(found.encode_png, "halfway_encode_png", found.decode_png,
                                     "halfway_decode_png", found.versions, "halfway_image_versions");
  if (!bound) return bound.error();
  return found;
}

std::filesystem::path image_library_file() {
  return HALFWAY_IMAGES;
}

}  // namespace halfway
