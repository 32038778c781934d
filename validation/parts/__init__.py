"""What several studies share, or one study is too long to hold."""
