#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace divot::output {

/// Parts of the page of a report, as they were when the library was built.
struct ReportAssets {
  std::string_view page, style;
  std::string code;        ///< of the page's own, in the order in which it runs
  std::string_view three;  ///< three.js; empty when it was not there
};
ReportAssets report_assets();

/// Puts `text` where `{{name}}` stands in the page.
std::string filled_in(std::string_view page,
                      std::initializer_list<std::pair<std::string_view, std::string_view>> texts);

}  // namespace divot::output
