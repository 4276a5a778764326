// mistake in line 2: a text without a font
text { "Hi" }
