// mistake in line 2: a picture with another extension
sphere { 0, 1 pigment { image_map { jpeg "picture.jpg" } } }
