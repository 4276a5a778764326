// mistake in line 2: a comment of other languages
# the floor
