#include "output/report_assets.h"

// The files are taken into the object as they are (CMakeLists.txt says where they lie), so that a program that was
// installed needs none of them beside it. A compiler has no faster way before #embed.
#define DIVOT_EMBED(name, path)                                                                                    \
  __asm__(".pushsection .rodata\n" #name "_begin:\n.incbin \"" path "\"\n" #name "_end:\n.byte 0\n.popsection\n"); \
  extern "C" const char name##_begin[], name##_end[];

DIVOT_EMBED(divot_report_html, DIVOT_REPORT_FOLDER "/page.html")
DIVOT_EMBED(divot_report_style, DIVOT_REPORT_FOLDER "/style.css")
DIVOT_EMBED(divot_report_data, DIVOT_REPORT_FOLDER "/data.js")
DIVOT_EMBED(divot_report_ground, DIVOT_REPORT_FOLDER "/ground.js")
DIVOT_EMBED(divot_report_stage, DIVOT_REPORT_FOLDER "/stage.js")
DIVOT_EMBED(divot_report_charts, DIVOT_REPORT_FOLDER "/charts.js")
DIVOT_EMBED(divot_report_main, DIVOT_REPORT_FOLDER "/main.js")
DIVOT_EMBED(divot_report_three, DIVOT_THREE_JS)

namespace divot::output {
namespace {

std::string_view between(const char* begin, const char* end) { return {begin, static_cast<std::size_t>(end - begin)}; }

}  // namespace

#define DIVOT_EMBEDDED(name) between(name##_begin, name##_end)

ReportAssets report_assets() {
  std::string code;
  for (const std::string_view part :
       {DIVOT_EMBEDDED(divot_report_data), DIVOT_EMBEDDED(divot_report_ground), DIVOT_EMBEDDED(divot_report_stage),
        DIVOT_EMBEDDED(divot_report_charts), DIVOT_EMBEDDED(divot_report_main)})
    code += part;
  return {.page = DIVOT_EMBEDDED(divot_report_html),
          .style = DIVOT_EMBEDDED(divot_report_style),
          .code = std::move(code),
          .three = DIVOT_EMBEDDED(divot_report_three)};
}

std::string filled_in(std::string_view page,
                      std::initializer_list<std::pair<std::string_view, std::string_view>> texts) {
  std::string out;
  while (!page.empty()) {
    const std::size_t open = page.find("{{"), close = page.find("}}", open);
    out += page.substr(0, open);
    if (open == page.npos || close == page.npos) break;
    const std::string_view name = page.substr(open + 2, close - open - 2);
    for (const auto& [key, text] : texts)
      if (key == name) out += text;
    page.remove_prefix(close + 2);
  }
  return out;
}

}  // namespace divot::output
