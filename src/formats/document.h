#pragma once
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/display_list.h"

namespace dstylize {

/// What a vector or skeleton file says about itself besides the drawing.
struct DocumentInfo {
    /// Size of the page. With one of them 0 it follows from the other and the drawing's proportions;
    /// with both 0 a picture pixel is 1/96 inch.
    double width_mm = 0, height_mm = 0;
    std::string title;
    /// Key and text: author, copyright, recipe, ... UTF-8; what is not valid is replaced by U+FFFD.
    std::vector<std::pair<std::string, std::string>> text;
    /// The list's paper picture as a PNG file, which SVG embeds; without it SVG has no paper picture.
    std::vector<std::byte> paper_png;
    std::vector<std::byte> cover_png;  ///< the list's cover, likewise
};

/// An SVG 1.1 document: viewBox in picture pixels, coordinates to 1/100 of one. The paper is a locked
/// layer (left out when transparent, never grained); each layer of the list is a group, and in it are
/// groups by stage and branch order, all of which Inkscape shows as layers. Every stroke is one closed
/// outline. Shapes keep within 0.05 u (1/1024 of the long side) of the list.
///
/// In a `max` layer of one colour strokes are sorted by stage and order; transparency is the group's, so
/// that overlaps do not show. Layers of several colours keep painting order.
///
/// A glowing layer is painted in its items' colours and screened over what lies below (SVG:
/// `mix-blend-mode: screen`); blurs are not vectors: pipeline/lit_ground.h puts halos into the paper picture.
///
/// Where the list mixes with its ground, the layers between two glowing ones are a group with that
/// `mix-blend-mode`. The cover is a last, locked layer.
///
/// Metadata: title, `author` and `copyright` as Dublin Core, and every text as
/// `<d:text key="KEY">...</d:text>` in the namespace urn:dstylize.
std::string svg_document(const DisplayList& list, const DocumentInfo& info);

/// A one-page PDF 1.5 with the outlines of the SVG. Document information: title; author; keywords: the
/// recipe; subject: the other texts as "key: text" lines. The creation date is fixed (1970-01-01), so
/// the same list gives the same bytes. Throws Error(failed) when Cairo does.
std::string pdf_document(const DisplayList& list, const DocumentInfo& info);

}  // namespace dstylize
