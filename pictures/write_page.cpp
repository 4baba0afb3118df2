#include "majorant/pictures/write_page.h"

#include "embedded/map_page_css.h"
#include "embedded/map_page_html.h"
#include "embedded/map_page_js.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/map_check.h"
#include "majorant/pictures/internal/page_data.h"
#include "majorant/pictures/page_text.h"

namespace majorant {

void write_page(const std::string& path, const MapPage& page) {
  require_sound(path, page.map);
  if (page.scaffold) require_sound(path, *page.scaffold);
  write_file_atomically(path, fill_in(map_page_html(), {{"title", html_text(page.title)},
                                                        {"style", std::string(map_page_css())},
                                                        {"data", script_json(page_data(page))},
                                                        {"script", std::string(map_page_js())}}));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
