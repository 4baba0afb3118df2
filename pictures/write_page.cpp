#include "majorant/pictures/write_page.h"

#include "majorant/io/internal/atomic_file.h"
#include "majorant/io/internal/map_check.h"

namespace majorant {

void write_page(const std::string& path, const MapPage& page) {
  require_sound(path, page.map);
  write_file_atomically(path, "<!doctype html>");
}

}  // namespace majorant
