#include "app/page_writer.h"

namespace lucarne {

void PageWriter::list(const std::vector<std::string>& items, const char* kind) {
  html_ += std::string("<ul class=\"") + kind + "\">";
  for (const std::string& item : items) html_ += "<li>" + escapeHtml(item) + "</li>";
  html_ += "</ul>\n";
}

void PageWriter::picture(const std::string& title, const std::string& caption, int width, int height,
                         const std::vector<std::uint8_t>& png) {
  html_ += "<figure><img alt=\"" + escapeHtml(title) + "\" width=\"" + std::to_string(width) + "\" height=\"" +
           std::to_string(height) + "\" src=\"" + dataUri("image/png", png) + "\"><figcaption><b>" + escapeHtml(title) +
           "</b> " + escapeHtml(caption) + "</figcaption></figure>\n";
}

void PageWriter::table(const Row& head, const std::vector<Row>& rows, bool numbers) {
  html_ += std::string("<div class=\"wide\"><table class=\"") + (numbers ? "numbers" : "words") + "\">";
  if (!head.empty()) {
    html_ += "<tr>";
    for (const std::string& cell : head) html_ += "<th>" + escapeHtml(cell) + "</th>";
    html_ += "</tr>";
  }
  for (const Row& row : rows) {
    html_ += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i)
      html_ += (i == 0 ? "<th scope=\"row\">" : "<td>") + escapeHtml(row[i]) + (i == 0 ? "</th>" : "</td>");
    html_ += "</tr>\n";
  }
  html_ += "</table></div>\n";
}

}  // namespace lucarne
