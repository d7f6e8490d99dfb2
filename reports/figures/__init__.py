"""One drawing a file: plain arrays in, a `reports.parts.content.Picture` out."""
