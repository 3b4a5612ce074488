;;; clsf-mode.el --- CL programs: colours, findings of compile, the server -*- lexical-binding: t -*-

;; Colours come from clsf-words.el, which is made from the records that the reader knows.

(require 'clsf-words)
(require 'compile)

(defconst clsf-font-lock-keywords
  `(("^\\s-*\\(?:REMARK\\|PPRINT\\)\\_>.*$" . font-lock-comment-face)
    ("'[^'\n]*'" . font-lock-string-face)
    ("^\\s-*TOOL PATH\\s-*/\\([^,\n]*\\)" 1 font-lock-function-name-face)
    ,@(mapcar (lambda (list)
                `(,(concat "^\\s-*\\(?:N?[0-9]+\\s-+\\)?" (regexp-opt (cdr list) t) "\\s-*\\(?:[/$]\\|$\\)")
                  1 ,(car list)))
              clsf-major-words)
    (,(concat "[/,]\\s-*" (regexp-opt clsf-minor-words t) "\\_>")
     1 font-lock-constant-face)
    ("\\(?:^\\|[/, \t]\\)\\([-+]?\\(?:[0-9]+\\.?[0-9]*\\|\\.[0-9]+\\)\\(?:[ED][-+]?[0-9]+\\)?\\)\\_>"
     1 font-lock-constant-face))
  "Words and numbers of CL programs.")

;;;###autoload
(define-derived-mode clsf-mode prog-mode "CLSF"
  "CL programs of NX, CATIA and Creo."
  (setq-local comment-start "$$ ")
  (setq-local font-lock-defaults '(clsf-font-lock-keywords nil t))
  (setq-local compile-command
              (concat "clsmith check --format line " (shell-quote-argument (or buffer-file-name "")))))

(modify-syntax-entry ?$ ". 12" clsf-mode-syntax-table)
(modify-syntax-entry ?\n ">" clsf-mode-syntax-table)

;;;###autoload
(add-to-list 'auto-mode-alist '("\\.\\(clsf?\\|ncl\\|apt\\(source\\)?\\)\\'" . clsf-mode))

;; Lines of `clsmith check --format line`.
(add-to-list 'compilation-error-regexp-alist-alist
             '(clsmith "^\\(.+?\\):\\([0-9]+\\):\\([0-9]+\\): CL[0-9]\\{4\\}: " 1 2 3))
(add-to-list 'compilation-error-regexp-alist 'clsmith)

(with-eval-after-load 'eglot
  (add-to-list 'eglot-server-programs '(clsf-mode . ("clsmith" "lsp"))))

(provide 'clsf-mode)
;;; clsf-mode.el ends here
