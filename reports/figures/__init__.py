"""One drawing a file: plain arrays in, a `reports.content.Picture` out."""
