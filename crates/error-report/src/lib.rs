//! Error figures against seconds: metrics, series, CSV, JSON and one HTML page.
