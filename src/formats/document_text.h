#pragma once
#include <string>
#include <string_view>

namespace dstylize {

/// Whether a file's bytes are a document of the kinds that we write (SVG, PDF, skeleton JSON), by their
/// beginning alone.
bool is_document(std::string_view file);

/// A text of DocumentInfo read back from a document that svg_document, pdf_document or skeleton_json made:
/// any key of an SVG or JSON, of a PDF only "recipe". Empty when there is none or the document is damaged.
std::string document_text(std::string_view file, std::string_view key);

}  // namespace dstylize
