# Why a recording cannot be written or read.

recording-unwritable = the recording “{ $path }” cannot be written: { $reason }
    .help = check the path, the rights and the room on the disk
recording-unreadable = the recording “{ $path }” cannot be read: { $reason }
    .help = check the path and the rights
recording-not-mcap = “{ $path }” is no MCAP
    .help = name a file that was written with --record
recording-cut = the recording “{ $path }” is cut off or damaged before anything is told in it
    .help = name another recording; there is nothing to take from this one
recording-foreign = the recording “{ $path }” has nothing of an ortho mission
    .help = name a file that was written with --record

# Why it is not read to its end.

cut-off = the file was cut off
damaged = the file is damaged
compressed = the compression “{ $how }” is not read here
