"""A well as a report: one set of tables and pictures, written as a page, a PDF and a workbook."""
