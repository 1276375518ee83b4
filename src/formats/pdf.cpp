#include <cairo-pdf.h>

#include <memory>
#include <new>

#include "core/error.h"
#include "formats/detail_vector.h"

namespace dstylize {
namespace {

constexpr double kPointsPerMm = 72 / 25.4;

struct SurfaceDeleter {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct ContextDeleter {
    void operator()(cairo_t* context) const { cairo_destroy(context); }
};

void check(cairo_status_t status) {
    if (status != CAIRO_STATUS_SUCCESS)
        throw Error(ErrorCode::failed, "", std::string("the PDF could not be made: ") + cairo_status_to_string(status),
                    "");
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
    try {
        static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
    } catch (const std::bad_alloc&) {
        return CAIRO_STATUS_NO_MEMORY;
    }
    return CAIRO_STATUS_SUCCESS;
}

void set_information(cairo_surface_t* surface, const DocumentInfo& info) {
    const auto set = [&](cairo_pdf_metadata_t which, std::string_view text) {
        if (!text.empty()) cairo_pdf_surface_set_metadata(surface, which, clean_text(text).c_str());
    };
    std::string subject;
    for (const auto& [key, text] : info.text)
        if (key != "author" && key != "recipe") subject += (subject.empty() ? "" : "\n") + key + ": " + text;
    set(CAIRO_PDF_METADATA_TITLE, info.title);
    set(CAIRO_PDF_METADATA_AUTHOR, text_of(info, "author"));
    set(CAIRO_PDF_METADATA_SUBJECT, subject);
    set(CAIRO_PDF_METADATA_KEYWORDS, text_of(info, "recipe"));
    set(CAIRO_PDF_METADATA_CREATOR, "dstylize");
    set(CAIRO_PDF_METADATA_CREATE_DATE, "1970-01-01T00:00:00Z");
}

void add_path(cairo_t* context, const CubicPath& path) {
    cairo_move_to(context, path.start.x, path.start.y);
    for (const CubicPiece& p : path.pieces) {
        if (p.straight)
            cairo_line_to(context, p.end.x, p.end.y);
        else
            cairo_curve_to(context, p.control1.x, p.control1.y, p.control2.x, p.control2.y, p.end.x, p.end.y);
    }
    cairo_close_path(context);
}

void paint_layer(cairo_t* context, const ShapeLayer& layer) {
    const bool grouped = layer.opacity < 1 || layer.light;
    if (grouped) cairo_push_group(context);
    for (const ShapeGroup& group : layer.groups)
        for (const Shape& shape : group.shapes) {
            const Rgba c = shape.colour;
            cairo_set_source_rgba(context, c.r, c.g, c.b, c.a);
            add_path(context, shape.path);
            cairo_fill(context);
        }
    if (!grouped) return;
    cairo_pop_group_to_source(context);
    if (layer.light) cairo_set_operator(context, CAIRO_OPERATOR_SCREEN);
    cairo_paint_with_alpha(context, layer.opacity);
    cairo_set_operator(context, CAIRO_OPERATOR_OVER);
}

cairo_operator_t cairo_operator(Mixing mixing) {
    switch (mixing) {
        case Mixing::over: return CAIRO_OPERATOR_OVER;
        case Mixing::multiply: return CAIRO_OPERATOR_MULTIPLY;
        case Mixing::screen: return CAIRO_OPERATOR_SCREEN;
        case Mixing::soft_light: return CAIRO_OPERATOR_SOFT_LIGHT;
    }
    return CAIRO_OPERATOR_OVER;
}

void paint_layers(cairo_t* context, const DisplayList& list, float tolerance) {
    visit_layers(
        list, tolerance, [&] { cairo_push_group(context); },
        [&](const ShapeLayer& layer) { paint_layer(context, layer); },
        [&] {
            cairo_pop_group_to_source(context);
            cairo_set_operator(context, cairo_operator(list.mixing));
            cairo_paint(context);
            cairo_set_operator(context, CAIRO_OPERATOR_OVER);
        });
}

/// The picture, stretched over the page.
void paint_picture(cairo_t* context, const Picture& picture, double width, double height) {
    const Extent extent = picture.extent();
    const std::unique_ptr<cairo_surface_t, SurfaceDeleter> image(
        cairo_image_surface_create(CAIRO_FORMAT_ARGB32, extent.x, extent.y));
    check(cairo_surface_status(image.get()));
    unsigned char* bytes = cairo_image_surface_get_data(image.get());
    const std::size_t stride = std::size_t(cairo_image_surface_get_stride(image.get()));
    for (int y = 0; y < extent.y; ++y) {
        auto* row = reinterpret_cast<std::uint32_t*>(bytes + std::size_t(y) * stride);
        for (int x = 0; x < extent.x; ++x) {
            const Rgba8 p = picture(x, y);
            const auto premultiplied = [&](std::uint8_t c) { return std::uint32_t((c * p.a + 127) / 255); };
            row[x] = std::uint32_t(p.a) << 24 | premultiplied(p.r) << 16 | premultiplied(p.g) << 8 | premultiplied(p.b);
        }
    }
    cairo_surface_mark_dirty(image.get());
    cairo_save(context);
    cairo_scale(context, width / extent.x, height / extent.y);
    cairo_set_source_surface(context, image.get(), 0, 0);
    cairo_pattern_set_extend(cairo_get_source(context), CAIRO_EXTEND_PAD);
    cairo_paint(context);
    cairo_restore(context);
}

}  // namespace

std::string pdf_document(const DisplayList& list, const DocumentInfo& info) {
    std::string bytes;
    const PageSize page = page_size(list, info);
    const double width_pt = page.width_mm * kPointsPerMm, height_pt = page.height_mm * kPointsPerMm;
    const std::unique_ptr<cairo_surface_t, SurfaceDeleter> surface(
        cairo_pdf_surface_create_for_stream(append, &bytes, width_pt, height_pt));
    check(cairo_surface_status(surface.get()));
    set_information(surface.get(), info);
    const std::unique_ptr<cairo_t, ContextDeleter> context(cairo_create(surface.get()));
    cairo_scale(context.get(), width_pt / list.width_px, height_pt / list.height_px);
    if (list.paper.picture) {
        paint_picture(context.get(), *list.paper.picture, list.width_px, list.height_px);
    } else if (const Rgba paper = list.paper.colour; paper.a > 0) {
        cairo_set_source_rgba(context.get(), paper.r, paper.g, paper.b, paper.a);
        cairo_paint(context.get());
    }
    const float tolerance = shape_tolerance_px(list);
    paint_layers(context.get(), list, tolerance);
    if (list.cover) paint_picture(context.get(), *list.cover, list.width_px, list.height_px);
    check(cairo_status(context.get()));
    cairo_surface_finish(surface.get());
    check(cairo_surface_status(surface.get()));
    return bytes;
}

}  // namespace dstylize
